// Runs the built program and keeps what a user would see: both outputs and the exit code.
#pragma once

#include <csignal>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include <sys/types.h>

namespace perentie::test {

/// The words that run the program: an emulator if there is one, and the program's path.
std::vector<std::string> perentie_command();

struct Surroundings {
  std::filesystem::path folder = ".";
  std::string input = {};        ///< on standard input
  std::string output_file = {};  ///< where standard output goes; empty: into `Outcome::output`
  /// Set beside the variables of the test.
  std::vector<std::pair<std::string, std::string>> variables = {};
};

struct Outcome {
  int exit_code = -1;  ///< 128 + N if signal N ended the program
  std::string output;
  std::string errors;
};

/// Any command; the first word is searched on the PATH.
Outcome run(const std::vector<std::string>& command, const Surroundings& around = {});
/// The program with these arguments.
Outcome perentie(const std::vector<std::string>& arguments, const Surroundings& around = {});
/// Whether a pipe is at its end after what was written, or the writer may go on.
enum class PipeEnd { closed, open };
/// The program with these arguments, and a signal `milliseconds` after the text was written to the
/// named pipe `pipe`, which an argument names.
Outcome interrupted_perentie(const std::vector<std::string>& arguments,
                             const std::filesystem::path& pipe, const std::string& text,
                             unsigned milliseconds, PipeEnd end = PipeEnd::closed,
                             int signal = SIGINT);

/// A folder of the running test, empty at first, removed when it goes out of scope.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  /// Writes a file and gives its path.
  std::string file(const std::string& name, const std::string& text) const;

 private:
  std::filesystem::path path_;
};

std::string read_text(const std::filesystem::path& file);

}  // namespace perentie::test
