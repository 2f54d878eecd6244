#include "check_run.hpp"

#include <pthread.h>

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <deque>
#include <iostream>
#include <iterator>
#include <mutex>
#include <new>

#include "perentie/base/check.hpp"

namespace perentie::cli {
namespace {

// So many checks run side by side at most. If events have no numbers beforehand, a script is loaded
// so many times at most.
constexpr std::size_t max_groups = 16;
// A script that holds more is not kept for the next assertion, nor one that holds this share of the
// memory.
constexpr std::uint64_t max_kept_bytes = std::uint64_t{256} << 20U;
constexpr std::uint64_t max_kept_share = 16;

constexpr base::LimitReached no_memory{base::LimitKind::memory};

std::optional<base::FileId> read_root(const std::string& path, Input& input) {
  if (path != "-") return input.read(path);
  std::string text{std::istreambuf_iterator<char>(std::cin), {}};
  return input.sources.add("<stdin>", std::move(text));
}

// A thread with room for deep terms: the default depends on the limits of the process. If the
// system has no thread to give, the work is not begun.
class Worker {
 public:
  explicit Worker(std::function<void()> work) : work_(std::move(work)) {
    constexpr std::size_t stack_bytes = std::size_t{64} << 20U;
    pthread_attr_t attributes;
    pthread_attr_init(&attributes);
    pthread_attr_setstacksize(&attributes, stack_bytes);
    started_ = pthread_create(
                   &thread_, &attributes,
                   [](void* self) -> void* {
                     static_cast<Worker*>(self)->work_();
                     return nullptr;
                   },
                   this) == 0;
    pthread_attr_destroy(&attributes);
  }
  ~Worker() {
    if (started_) pthread_join(thread_, nullptr);
  }
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;

  bool started() const { return started_; }

 private:
  std::function<void()> work_;
  pthread_t thread_{};
  bool started_ = false;
};

// The part of `items` that group `index` of `count` has; parts follow each other.
std::span<const std::size_t> part_of(std::span<const std::size_t> items, std::size_t index,
                                     std::size_t count) {
  const std::size_t begin = items.size() * index / count;
  const std::size_t end = items.size() * (index + 1) / count;
  return items.subspan(begin, end - begin);
}

}  // namespace

std::unique_ptr<CheckRun> CheckRun::load(const std::string& path, Input& input) {
  const auto root = read_root(path, input);
  if (!root) return nullptr;
  std::unique_ptr<CheckRun> run(new CheckRun(input));
  run->root_ = *root;
  parser::ParseOptions options;
  options.load = [&files = run->files_](const std::string& file) {
    return files.emplace(file, base::read_file(file)).first->second;
  };
  run->script_ = semantics::Script::load(*root, input.sources, input.diagnostics, options);
  if (run->script_ == nullptr) return nullptr;
  run->has_numbered_events_ = run->script_->number_events();
  run->assertions_ = semantics::assertions_of(run->script_->tree());
  run->prints_ = semantics::prints_of(run->script_->tree());
  return run;
}

std::unique_ptr<CheckRun::Copy> CheckRun::copy() const {
  auto copy = std::make_unique<Copy>();
  const base::SourceMap& original = input_.sources;
  const auto root =
      copy->input.sources.add(std::string(original.path(root_)), std::string(original.text(root_)));
  parser::ParseOptions options;
  options.load = [this](const std::string& file) { return files_.at(file); };
  if (root) {
    copy->script =
        semantics::Script::load(*root, copy->input.sources, copy->input.diagnostics, options);
  }
  PERENTIE_CHECK(copy->script != nullptr, "a script that was loaded cannot be loaded again");
  copy->script->number_events();
  return copy;
}

PrintedValue CheckRun::evaluate(const semantics::ScriptPrint& print, const base::Limits& limits) {
  PrintedValue printed{&print, {}, {}, {}};
  if (is_starved_) {
    printed.limit = no_memory;
    return printed;
  }
  script_->set_limits(limits);
  printed.value = script_->evaluate(print, printed.diagnostics);
  if (!printed.value) printed.limit = script_->limit();
  return printed;
}

CheckedAssertion CheckRun::check_one(semantics::Script& script, std::size_t number,
                                     const lts::ExploreOptions& exploration,
                                     const CheckOptions& options) {
  using Outcome = semantics::CheckResult::Outcome;
  CheckedAssertion checked{number, &assertions_[number - 1], {.outcome = Outcome::error}, {}, {}};
  checked.result = semantics::check(script, *checked.assertion, exploration, checked.diagnostics);
  if (options.explain && checked.result.witness) {
    checked.explanation = semantics::explain(
        script, *checked.assertion, *checked.result.witness,
        {.limits = exploration.limits, .with_components = options.with_components});
  }
  return checked;
}

CheckedAssertion CheckRun::without_memory(std::size_t number) const {
  using Outcome = semantics::CheckResult::Outcome;
  return {number,
          &assertions_[number - 1],
          {.outcome = Outcome::inconclusive, .limit = no_memory},
          {},
          {}};
}

// The script for a part of the assertions: the first part has that of the run.
void CheckRun::take_script(Hand& hand, std::size_t part, const CheckOptions& options) {
  const auto max_memory = options.limits.max_memory_bytes.value_or(max_kept_bytes * max_kept_share);
  const std::uint64_t max_bytes = std::min(max_kept_bytes, max_memory / max_kept_share);
  const bool is_kept =
      hand.script != nullptr && has_numbered_events_ && hand.script->memory_bytes() <= max_bytes;
  if (is_kept) return;
  drop_script(hand);
  try {
    if (part != 0) hand.copy = copy();
    hand.script = part == 0 ? script_.get() : hand.copy->script.get();
    hand.script->set_leaf_compression(options.leaf_compression);
    hand.script->show_calls(options.show_calls);
  } catch (const std::bad_alloc&) {
    is_starved_ = is_starved_ || part == 0;
    hand = {};
  }
}

void CheckRun::drop_script(Hand& hand) {
  if (hand.script != nullptr) {
    const std::lock_guard lock(compressions_mutex_);
    try {
      for (std::string& name : hand.script->compressions_given_up()) {
        compressions_.insert(std::move(name));
      }
    } catch (const std::bad_alloc&) {
      // Then a note on the number of states is missing.
    }
  }
  hand = {};
}

void CheckRun::check(std::span<const std::size_t> numbers, const CheckOptions& options,
                     const std::function<bool(CheckedAssertion)>& consume) {
  const std::size_t groups = std::min(numbers.size(), max_groups);
  const std::size_t parts = has_numbered_events_ ? numbers.size() : groups;
  const std::size_t jobs = std::min(std::max<std::size_t>(options.jobs, 1), groups);
  base::Limits limits = options.limits;
  if (limits.max_memory_bytes && jobs > 0) *limits.max_memory_bytes /= jobs;
  if (jobs > 0) limits.workers = std::max(limits.workers / static_cast<unsigned>(jobs), 1U);
  std::mutex mutex;
  std::condition_variable changed;
  std::vector<std::optional<CheckedAssertion>> results(numbers.size());
  std::mutex output;  // held while something is shown
  std::atomic<std::size_t> next_part{0};
  std::atomic<std::size_t> awaited{0};  // the place that is handed over next
  std::atomic<bool> stopped{false};

  const auto check_part = [&](std::span<const std::size_t> part, Hand& hand) {
    auto place = static_cast<std::size_t>(part.data() - numbers.data());
    for (const std::size_t number : part) {
      if (stopped) return;
      lts::ExploreOptions exploration{.limits = limits};
      if (options.progress) {
        exploration.progress = [&, place](const lts::ExploreProgress& progress) {
          if (awaited != place) return;
          const std::lock_guard shown(output);
          options.progress(progress);
        };
      }
      CheckedAssertion checked = without_memory(number);
      if (hand.script != nullptr) {
        try {
          checked = check_one(*hand.script, number, exploration, options);
        } catch (const std::bad_alloc&) {
          is_starved_ = is_starved_ || hand.copy == nullptr;
          hand = {};
        }
      }
      const std::lock_guard lock(mutex);
      results[place++] = std::move(checked);
      changed.notify_one();
    }
  };

  const auto work = [&] {
    Hand hand;
    for (std::size_t part = next_part++; part < parts; part = next_part++) {
      take_script(hand, part, options);
      check_part(part_of(numbers, part, parts), hand);
    }
    drop_script(hand);
  };
  std::deque<Worker> workers;
  for (std::size_t w = 0; w < jobs; ++w) workers.emplace_back(work);
  if (std::ranges::none_of(workers, &Worker::started)) work();
  for (std::size_t place = 0; place < numbers.size(); ++place) {
    awaited = place;
    std::optional<CheckedAssertion> checked;
    {
      std::unique_lock lock(mutex);
      changed.wait(lock, [&] { return results[place].has_value(); });
      checked.swap(results[place]);
    }
    const std::lock_guard shown(output);
    if (!consume(std::move(*checked))) break;
  }
  stopped = true;
  workers.clear();
}

std::vector<std::string> CheckRun::compressions_given_up() const {
  std::set<std::string> names = compressions_;
  for (const std::string& name : script_->compressions_given_up()) names.insert(name);
  return {names.begin(), names.end()};
}

ExitCode worse(ExitCode a, ExitCode b) {
  constexpr ExitCode order[] = {ExitCode::ok, ExitCode::inconclusive, ExitCode::refuted,
                                ExitCode::model_error, ExitCode::io_error};
  return std::max(a, b, [&](ExitCode x, ExitCode y) {
    return std::ranges::find(order, x) < std::ranges::find(order, y);
  });
}

ExitCode worse(ExitCode code, semantics::CheckResult::Outcome outcome) {
  using Outcome = semantics::CheckResult::Outcome;
  const ExitCode own = outcome == Outcome::holds          ? ExitCode::ok
                       : outcome == Outcome::fails        ? ExitCode::refuted
                       : outcome == Outcome::inconclusive ? ExitCode::inconclusive
                                                          : ExitCode::model_error;
  return worse(code, own);
}

}  // namespace perentie::cli
