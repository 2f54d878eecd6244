namespace perentie::monitor {}
