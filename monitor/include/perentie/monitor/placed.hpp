// A value with the place of the text that it comes from, if it comes from one.
#pragma once

#include <optional>

#include "perentie/base/source.hpp"

namespace perentie::monitor {

template <class T>
struct Placed {
  T value;
  std::optional<base::Span> span;  ///< none: from the command line or a default
};

}  // namespace perentie::monitor
