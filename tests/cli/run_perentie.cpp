#include "run_perentie.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

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

void redirect(int descriptor, const std::string& file, int flags) {
  const int opened = open(file.c_str(), flags, 0600);
  if (opened < 0 || dup2(opened, descriptor) < 0) _exit(126);
  close(opened);
}

pid_t start(const std::vector<std::string>& command, const Surroundings& around,
            const std::filesystem::path& streams, const std::string& output_file) {
  const pid_t child = fork();
  if (child != 0) return child;
  redirect(STDIN_FILENO, streams / "in", O_RDONLY);
  redirect(STDOUT_FILENO, output_file, O_WRONLY | O_CREAT | O_TRUNC);
  redirect(STDERR_FILENO, streams / "err", O_WRONLY | O_CREAT | O_TRUNC);
  if (chdir(around.folder.c_str()) != 0) _exit(126);
  for (const auto& [name, value] : around.variables) setenv(name.c_str(), value.c_str(), 1);
  std::vector<char*> words;
  for (const std::string& word : command) words.push_back(const_cast<char*>(word.c_str()));
  words.push_back(nullptr);
  execvp(words[0], words.data());
  _exit(127);
}

template <typename WhileItRuns>
Outcome run_with(const std::vector<std::string>& command, const Surroundings& around,
                 WhileItRuns while_it_runs) {
  const TemporaryFolder streams;
  streams.file("in", around.input);
  const std::string output =
      around.output_file.empty() ? (streams.path() / "out").string() : around.output_file;
  const pid_t child = start(command, around, streams.path(), output);
  if (child < 0) throw std::runtime_error("fork failed");
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
                             unsigned milliseconds) {
  if (mkfifo(pipe.c_str(), 0600) != 0) throw std::runtime_error("mkfifo failed");
  return run_with(with_program(arguments), {}, [&](pid_t child) {
    std::ofstream(pipe) << text;  // returns once the program has opened the pipe
    std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds));
    kill(child, SIGINT);
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
