// The exit codes of the program: part of its interface (docs/cli.md).
#pragma once

namespace perentie::cli {

enum class ExitCode : int {
  ok = 0,            ///< done; every property holds, the trace conforms
  refuted = 1,       ///< a property fails, the trace violates the model
  usage = 2,         ///< the command line, a configuration or a mapping is wrong
  model_error = 3,   ///< the model does not parse, resolve or evaluate
  inconclusive = 4,  ///< a budget ran out before there was an answer
  io_error = 5,      ///< something could not be read or written, a trace is malformed
  interrupted = 130,
};

}  // namespace perentie::cli
