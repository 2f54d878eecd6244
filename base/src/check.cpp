#include "perentie/base/check.hpp"

#include <cstdio>
#include <cstdlib>

namespace perentie::base {

void check_failed(const char* file, int line, const char* condition, const char* message) {
  std::fprintf(stderr,
               "perentie: internal error: %s\n  check `%s` at %s:%d\n"
               "  This is a bug in perentie, not in your input. Please report it.\n",
               message, condition, file, line);
  std::abort();
}

}  // namespace perentie::base
