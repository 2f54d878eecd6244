// overload{...}: one visitor out of several lambdas, for exhaustive std::visit.
#pragma once

namespace perentie::base {

template <class... Fs>
struct overload : Fs... {
  using Fs::operator()...;
};
template <class... Fs>
overload(Fs...) -> overload<Fs...>;

}  // namespace perentie::base
