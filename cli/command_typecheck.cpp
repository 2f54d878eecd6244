// perentie typecheck: whether a script is well-formed and well-typed, and the types of what it
// defines.
#include <memory>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "commands.hpp"
#include "model.hpp"

namespace perentie::cli {
namespace {

struct Options {
  std::string file;
  std::string format = "text";
  bool list = false;
};

using Json = nlohmann::ordered_json;

Json place(const base::SourceMap& sources, const std::optional<base::Span>& span) {
  if (!span) return nullptr;
  const base::Position position = sources.position(span->begin);
  return {{"file", sources.path(sources.file_of(span->begin))},
          {"line", position.line},
          {"column", position.column}};
}

Json diagnostics_as_json(const Input& input) {
  Json list = Json::array();
  for (const base::Diagnostic& d : input.diagnostics.all()) {
    Json notes = Json::array();
    for (const base::Note& note : d.notes) {
      notes.push_back({{"at", place(input.sources, note.span)}, {"message", note.message}});
    }
    list.push_back({{"code", d.code->id},
                    {"severity", d.code->severity == base::Severity::error ? "error" : "warning"},
                    {"at", place(input.sources, d.span)},
                    {"message", d.message},
                    {"notes", std::move(notes)}});
  }
  return list;
}

ExitCode typecheck(const Options& options, Console& console) {
  Input input;
  const auto file = input.read(options.file);
  const auto script =
      file ? semantics::Script::load(*file, input.sources, input.diagnostics) : nullptr;
  const auto types = script ? script->types() : std::vector<semantics::Script::TypedName>{};
  if (options.format == "json") {
    Json definitions = Json::array();
    for (const auto& [name, type] : types) {
      definitions.push_back({{"name", name}, {"type", type}});
    }
    const Json report{{"schema", "perentie.typecheck/1"},
                      {"file", options.file},
                      {"well_typed", script != nullptr},
                      {"definitions", std::move(definitions)},
                      {"diagnostics", diagnostics_as_json(input)}};
    console.result(report.dump(2, ' ', false, Json::error_handler_t::replace) + '\n');
    return script ? ExitCode::ok : input.failure(ExitCode::model_error);
  }
  console.print(input.diagnostics, input.sources);
  if (!script) return input.failure(ExitCode::model_error);
  if (options.list) {
    for (const auto& [name, type] : types) {
      console.result(fmt::format("{} :: {}\n", name, type));
    }
  } else {
    console.result(fmt::format("{}: well-typed, {} definitions\n", options.file, types.size()));
  }
  return ExitCode::ok;
}

}  // namespace

Command add_typecheck(CLI::App& program) {
  const auto options = std::make_shared<Options>();
  CLI::App* app = program.add_subcommand(
      "typecheck", "Check a script without running it, and show the types of its definitions");
  app->add_option("FILE", options->file, "The CSPM script")->required();
  app->add_flag("-l,--list", options->list, "Print every definition with its type");
  app->add_option("--format", options->format, "text, or json: definitions and diagnostics")
      ->check(CLI::IsMember({"text", "json"}))
      ->capture_default_str();
  app->footer(
      "Examples:\n"
      "  perentie typecheck corpus/rover/rover.csp\n"
      "  perentie typecheck corpus/rover/rover.csp --list");
  return {app, [options](Console& console) { return typecheck(*options, console); }};
}

}  // namespace perentie::cli
