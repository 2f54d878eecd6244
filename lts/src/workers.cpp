#include "perentie/lts/workers.hpp"

#include <system_error>

namespace perentie::lts {

namespace {

// Parts that follow each other are short: a thread that sleeps would be woken too late.
void wait_for_change(const std::atomic<std::uint32_t>& value, std::uint32_t old) {
  constexpr int spins = 4'000;
  for (int i = 0; i < spins; ++i) {
    if (value.load(std::memory_order_relaxed) != old) break;
#if defined(__x86_64__)
    __builtin_ia32_pause();
#endif
  }
  value.wait(old);
}

}  // namespace

Workers::~Workers() {
  part_ = nullptr;
  ++task_;
  task_.notify_all();
  for (std::thread& thread : threads_) thread.join();
}

void Workers::run(const std::function<void(unsigned)>& part) {
  if (!has_hired_) hire();
  part_ = &part;
  thrown_.assign(count_, nullptr);
  working_ = static_cast<std::uint32_t>(threads_.size());
  ++task_;
  task_.notify_all();
  do_part(0);
  for (auto worker = static_cast<unsigned>(threads_.size() + 1); worker < count_; ++worker) {
    do_part(worker);
  }
  for (std::uint32_t left = working_; left != 0; left = working_) wait_for_change(working_, left);
  for (const std::exception_ptr& thrown : thrown_) {
    if (thrown) std::rethrow_exception(thrown);
  }
}

void Workers::hire() {
  has_hired_ = true;
  try {
    for (unsigned worker = 1; worker < count_; ++worker) {
      threads_.emplace_back([this, worker] { work(worker); });
    }
  } catch (const std::system_error&) {
    // The system has no more threads.
  }
}

void Workers::work(unsigned worker) {
  for (std::uint32_t task = 0;; ++task) {
    wait_for_change(task_, task);
    if (part_ == nullptr) return;
    do_part(worker);
    if (--working_ == 0) working_.notify_one();
  }
}

void Workers::do_part(unsigned worker) {
  try {
    (*part_)(worker);
  } catch (...) {
    thrown_[worker] = std::current_exception();
  }
}

}  // namespace perentie::lts
