namespace perentie::semantics {}
