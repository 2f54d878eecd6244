// PreservedInScript: what compressions must preserve, for as long as it lives.
#pragma once

#include "perentie/semantics/compression.hpp"
#include "perentie/semantics/script.hpp"

namespace perentie::semantics {

class PreservedInScript {
 public:
  PreservedInScript(Script& script, Preserved preserved)
      : script_(script), before_(script.preserved()) {
    script_.set_preserved(preserved);
  }
  ~PreservedInScript() { script_.set_preserved(before_); }
  PreservedInScript(const PreservedInScript&) = delete;
  PreservedInScript& operator=(const PreservedInScript&) = delete;

 private:
  Script& script_;
  Preserved before_;
};

}  // namespace perentie::semantics
