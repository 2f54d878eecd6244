// Workers: threads that do the parts of a task together.
#pragma once

#include <atomic>
#include <cstdint>
#include <exception>
#include <functional>
#include <thread>
#include <vector>

namespace perentie::lts {

class Workers {
 public:
  /// `count` workers, at least one; the first is the caller. The others begin to exist with the
  /// first task. The caller does the parts of those for whom the system has no thread.
  explicit Workers(unsigned count) : count_(count < 1 ? 1 : count) {}
  ~Workers();
  Workers(const Workers&) = delete;
  Workers& operator=(const Workers&) = delete;

  unsigned count() const { return count_; }

  /// Calls `part(w)` for w = 0, 1, ..., `count()` - 1, side by side, 0 on this thread, and returns
  /// when all have ended. Throws again what one of them threw.
  void run(const std::function<void(unsigned)>& part);

 private:
  void hire();
  void work(unsigned worker);
  void do_part(unsigned worker);

  unsigned count_;
  bool has_hired_ = false;
  std::vector<std::thread> threads_;                     // of the workers from 1 on
  const std::function<void(unsigned)>* part_ = nullptr;  // nothing: there will be no more
  std::atomic<std::uint32_t> task_{0};                   // its number; a change is the start signal
  std::atomic<std::uint32_t> working_{0};                // threads that are still at their part
  std::vector<std::exception_ptr> thrown_;               // by worker
};

}  // namespace perentie::lts
