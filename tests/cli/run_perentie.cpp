#include "run_perentie.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <sstream>
#include <stdexcept>
#include <thread>

namespace perentie::test {
namespace {

// The variables of the test with those of `around` before them: the first of a name counts.
std::vector<std::string> environment_of(const Surroundings& around) {
  std::vector<std::string> variables;
  for (const auto& [name, value] : around.variables) variables.push_back(name + "=" + value);
  for (char** variable = environ; *variable != nullptr; ++variable) {
    const std::string text = *variable;
    const bool is_set =
        std::any_of(around.variables.begin(), around.variables.end(), [&](const auto& set) {
          return text.compare(0, set.first.size() + 1, set.first + "=") == 0;
        });
    if (!is_set) variables.push_back(text);
  }
  return variables;
}

std::vector<char*> pointers_to(std::vector<std::string>& words) {
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  return pointers;
}

// posix_spawn and not fork: under qemu-user 7.2 a forked child never ends.
pid_t start(std::vector<std::string> command, const Surroundings& around,
            const std::filesystem::path& streams, const std::string& output_file) {
  constexpr int written = O_WRONLY | O_CREAT | O_TRUNC;
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, (streams / "in").c_str(), O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, output_file.c_str(), written, 0600);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, (streams / "err").c_str(), written,
                                   0600);
  posix_spawn_file_actions_addchdir_np(&actions, around.folder.c_str());
  std::vector<std::string> variables = environment_of(around);
  pid_t child = -1;
  const int error = posix_spawnp(&child, command[0].c_str(), &actions, nullptr,
                                 pointers_to(command).data(), pointers_to(variables).data());
  posix_spawn_file_actions_destroy(&actions);
  if (error != 0) throw std::runtime_error("cannot run " + command[0]);
  return child;
}

template <typename WhileItRuns>
Outcome run_with(const std::vector<std::string>& command, const Surroundings& around,
                 WhileItRuns while_it_runs) {
  const TemporaryFolder streams;
  streams.file("in", around.input);
  const std::string output =
      around.output_file.empty() ? (streams.path() / "out").string() : around.output_file;
  const pid_t child = start(command, around, streams.path(), output);
  while_it_runs(child);
  int status = 0;
  if (waitpid(child, &status, 0) != child) throw std::runtime_error("waitpid failed");
  Outcome outcome;
  outcome.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  if (around.output_file.empty()) outcome.output = read_text(output);
  outcome.errors = read_text(streams.path() / "err");
  return outcome;
}

std::vector<std::string> with_program(const std::vector<std::string>& arguments) {
  std::vector<std::string> command = perentie_command();
  command.insert(command.end(), arguments.begin(), arguments.end());
  return command;
}

}  // namespace

std::vector<std::string> perentie_command() {
  std::vector<std::string> words;
  std::istringstream all(PERENTIE_COMMAND);
  for (std::string word; std::getline(all, word, '|');) {
    if (!word.empty()) words.push_back(word);
  }
  return words;
}

Outcome run(const std::vector<std::string>& command, const Surroundings& around) {
  return run_with(command, around, [](pid_t) {});
}

Outcome perentie(const std::vector<std::string>& arguments, const Surroundings& around) {
  return run(with_program(arguments), around);
}

Outcome interrupted_perentie(const std::vector<std::string>& arguments,
                             const std::filesystem::path& pipe, const std::string& text,
                             unsigned milliseconds, PipeEnd end, int signal) {
  if (mkfifo(pipe.c_str(), 0600) != 0) throw std::runtime_error("mkfifo failed");
  return run_with(with_program(arguments), {}, [&](pid_t child) {
    std::ofstream writer(pipe);  // returns once the program has opened the pipe
    writer << text << std::flush;
    if (end == PipeEnd::closed) writer.close();
    std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds));
    kill(child, signal);
  });
}

TemporaryFolder::TemporaryFolder() {
  std::string name = (std::filesystem::temp_directory_path() / "perentie-XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("mkdtemp failed");
  path_ = name;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

std::string TemporaryFolder::file(const std::string& name, const std::string& text) const {
  std::ofstream(path_ / name, std::ios::binary) << text;
  return (path_ / name).string();
}

std::string read_text(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

}  // namespace perentie::test
