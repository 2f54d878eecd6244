// JSON, JUnit and SARIF.
#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "check_report.hpp"
#include "version.hpp"
#include "witness_text.hpp"
#include "xml.hpp"

namespace perentie::cli {
namespace {

using Json = nlohmann::ordered_json;
using boost::property_tree::ptree;
using semantics::Behaviour;
using semantics::CheckResult;
using semantics::Explanation;
using semantics::Witness;
using Outcome = CheckResult::Outcome;

std::string text_of(const Json& json) {
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

Json place_of(base::Offset offset, const base::SourceMap& sources) {
  const base::Position at = sources.position(offset);
  return {{"file", at.path}, {"line", at.line}, {"column", at.column}};
}

Json trace_with_gaps(const std::vector<std::string>& trace) {
  Json list = Json::array();
  for (const std::string& event : trace) list.push_back(event.empty() ? Json() : Json(event));
  return list;
}

// Recursion is as deep as the components nest, which is bounded.
Json json_of(const Behaviour& b, const base::SourceMap& sources) {
  Json json{{"name", b.name}, {"trace", trace_with_gaps(b.trace)}};
  Json states = Json::array();
  for (const Behaviour::State& state : b.states) states.push_back(state.term);
  if (!states.empty()) json["states"] = std::move(states);
  if (!b.event.empty()) json["event"] = b.event;
  if (b.kind == Behaviour::Kind::acceptance) json["offered"] = b.acceptance;
  if (b.kind == Behaviour::Kind::loop) json["loop_start"] = b.loop_start;
  if (b.definition) json["defined_at"] = place_of(b.definition->begin, sources);
  for (const Behaviour& component : b.components) {
    json["components"].push_back(json_of(component, sources));
  }
  return json;
}

Json json_of(const Explanation& explanation, const base::SourceMap& sources) {
  Json json{{"behaviour", json_of(explanation.implementation, sources)}};
  if (explanation.specification && explanation.specification->kind != Behaviour::Kind::irrelevant) {
    json["other_behaviour"] = json_of(*explanation.specification, sources);
  }
  json["revealed_trace"] = explanation.revealed_trace;
  Json blocked = Json::array();
  for (const semantics::Blocked& b : explanation.blocked) {
    blocked.push_back({{"event", b.event}, {"offered_by", b.ready}, {"refused_by", b.refusing}});
  }
  json["blocked"] = std::move(blocked);
  return json;
}

Json json_of(const CheckedAssertion& checked, const CheckReport& report) {
  const CheckResult& result = checked.result;
  Json json{{"line", report.sources.position(checked.assertion->span.begin).line},
            {"assertion", checked.assertion->text},
            {"outcome", semantics::name_of(result.outcome)},
            {"visited_states", result.counts.states},
            {"visited_transitions", result.counts.transitions},
            {"visited_plys", result.counts.plys},
            {"seconds", result.seconds}};
  if (result.limit) json["limit"] = base::describe(*result.limit);
  if (!result.witness) return json;
  const Witness& w = *result.witness;
  Json witness{{"kind", semantics::name_of(w.kind)}, {"trace", w.trace}};
  if (!w.event.empty()) witness["event"] = w.event;
  if (w.kind == Witness::Kind::acceptance || w.is_refused || !w.offered.empty()) {
    witness["offered"] = w.offered;
  }
  if (!w.allowed.empty()) witness["allowed"] = w.allowed;
  for (const Witness::Observation& o : w.observed) {
    witness["observed"].push_back({{"after", o.place}, {"offered", o.offered}});
  }
  if (!w.state.empty()) witness["state"] = w.state;
  if (checked.explanation) {
    witness["explanation"] = json_of(*checked.explanation, report.sources);
    witness["replay"] = replay_command(checked, report);
  }
  json["counterexample"] = std::move(witness);
  return json;
}

Json json_of(const base::Diagnostic& d, const base::SourceMap& sources) {
  Json json{{"code", d.code->id}, {"message", d.message}};
  if (d.span) json["at"] = place_of(d.span->begin, sources);
  return json;
}

// The key is there only if there are some.
void add_errors(const base::Diagnostics& diagnostics, const base::SourceMap& sources, Json& json) {
  for (const base::Diagnostic& d : diagnostics.all()) json["errors"].push_back(json_of(d, sources));
}

std::string failure_text(const CheckedAssertion& checked) {
  const Witness& w = *checked.result.witness;
  std::string text = fmt::format("after {} {}", trace_of(w.trace), behaviour_of(w));
  if (const std::string allowed = expectation_of(w); !allowed.empty()) text += "; " + allowed;
  return text;
}

// Why an assertion has no verdict.
std::string no_verdict_text(const CheckedAssertion& checked) {
  if (checked.result.limit) return base::describe(*checked.result.limit);
  std::string text;
  for (const base::Diagnostic& d : checked.diagnostics.all()) {
    if (d.code->severity != base::Severity::error) continue;
    text += (text.empty() ? "" : "; ") + d.message;
  }
  return text;
}

std::string what_fails(const CheckedAssertion& checked) {
  return checked.result.witness ? failure_text(checked) : "what is negated holds";
}

// --- SARIF ---

// The path of a file as a URI reference.
std::string uri_of(std::string_view path) {
  std::string uri = path.substr(0, 1) == "/" ? "file://" : "";
  for (const char c : path) {
    const auto byte = static_cast<unsigned char>(c);
    const bool is_plain =
        std::isalnum(byte) != 0 || std::string_view("/._-~").find(c) != std::string_view::npos;
    uri += is_plain ? std::string(1, c) : fmt::format("%{:02X}", byte);
  }
  return uri;
}

Json location_of(base::Span span, const base::SourceMap& sources) {
  const base::Position begin = sources.position(span.begin);
  const base::Position end = sources.position(span.end);
  return {{"physicalLocation",
           {{"artifactLocation", {{"uri", uri_of(begin.path)}}},
            {"region",
             {{"startLine", begin.line},
              {"startColumn", begin.column},
              {"endLine", end.line},
              {"endColumn", end.column}}}}}};
}

Json sarif_result(std::string_view rule, std::string_view level, const std::string& message,
                  std::optional<base::Span> span, const base::SourceMap& sources) {
  Json result{{"ruleId", rule}, {"level", level}, {"message", {{"text", message}}}};
  if (span) result["locations"] = Json::array({location_of(*span, sources)});
  return result;
}

// The steps of the counterexample, at the assertion.
Json code_flow(const CheckedAssertion& checked, const base::SourceMap& sources) {
  Json steps = Json::array();
  const auto add = [&](const std::string& message) {
    Json location = location_of(checked.assertion->span, sources);
    location["message"] = {{"text", message}};
    steps.push_back({{"location", std::move(location)}});
  };
  for (const std::string& event : checked.result.witness->trace) add(event);
  add(behaviour_of(*checked.result.witness));
  return {{"threadFlows", Json::array({{{"locations", std::move(steps)}}})}};
}

void add_diagnostics(const base::Diagnostics& diagnostics, const base::SourceMap& sources,
                     Json& results) {
  for (const base::Diagnostic& d : diagnostics.all()) {
    const bool is_error = d.code->severity == base::Severity::error;
    results.push_back(
        sarif_result(d.code->id, is_error ? "error" : "warning", d.message, d.span, sources));
  }
}

}  // namespace

std::string as_json(const CheckReport& report) {
  Json prints = Json::array();
  for (const PrintedValue& printed : report.prints) {
    Json print{{"line", report.sources.position(printed.print->span.begin).line},
               {"expression", printed.print->text}};
    if (printed.value) print["value"] = *printed.value;
    if (printed.limit) print["limit"] = base::describe(*printed.limit);
    add_errors(printed.diagnostics, report.sources, print);
    prints.push_back(std::move(print));
  }
  Json list = Json::array();
  for (const CheckedAssertion& checked : report.assertions) {
    list.push_back(json_of(checked, report));
    if (checked.diagnostics.has_errors()) {
      add_errors(checked.diagnostics, report.sources, list.back());
    }
  }
  Json document{{"schema", "perentie.check/1"},
                {"file", report.file},
                {"prints", std::move(prints)},
                {"assertions", std::move(list)}};
  add_errors(report.load_errors, report.sources, document);
  return text_of(document);
}

std::string as_junit(const CheckReport& report) {
  ptree suite;
  suite.put("<xmlattr>.name", xml_text(report.file));
  std::size_t failures = 0;
  std::size_t errors = 0;
  double seconds = 0;
  const auto add_case = [&](const std::string& name, double time, std::size_t line) -> ptree& {
    ptree& test = suite.add("testcase", "");
    test.put("<xmlattr>.name", xml_text(name));
    test.put("<xmlattr>.classname", xml_text(report.file));
    test.put("<xmlattr>.file", xml_text(report.file));
    test.put("<xmlattr>.line", line);
    test.put("<xmlattr>.time", fmt::format("{:.3f}", time));
    return test;
  };
  const auto add_outcome = [](ptree& test, const std::string& what, const std::string& type,
                              const std::string& message, const std::string& body) {
    ptree& outcome = test.add(what, xml_text(body));
    outcome.put("<xmlattr>.message", xml_text(message));
    outcome.put("<xmlattr>.type", type);
  };
  if (report.load_errors.has_errors()) {
    std::string text;
    for (const base::Diagnostic& d : report.load_errors.all()) {
      text += base::render(d, report.sources);
    }
    add_outcome(add_case("load", 0, 1), "error", "script", "the script has errors", text);
    ++errors;
  }
  for (const CheckedAssertion& checked : report.assertions) {
    const CheckResult& result = checked.result;
    seconds += result.seconds;
    ptree& test =
        add_case(fmt::format("{}. {}", checked.number, checked.assertion->text), result.seconds,
                 report.sources.position(checked.assertion->span.begin).line);
    if (result.outcome == Outcome::holds) continue;
    if (result.outcome == Outcome::fails) {
      ++failures;
      add_outcome(test, "failure", "refuted", what_fails(checked),
                  assertion_as_text(checked, report));
    } else {
      ++errors;
      std::string text;
      for (const base::Diagnostic& d : checked.diagnostics.all()) {
        text += base::render(d, report.sources);
      }
      add_outcome(test, "error", std::string(semantics::name_of(result.outcome)),
                  no_verdict_text(checked), text);
    }
  }
  suite.put("<xmlattr>.tests",
            report.assertions.size() + (report.load_errors.has_errors() ? 1 : 0));
  suite.put("<xmlattr>.failures", failures);
  suite.put("<xmlattr>.errors", errors);
  suite.put("<xmlattr>.time", fmt::format("{:.3f}", seconds));
  ptree document;
  document.add_child("testsuites.testsuite", suite);
  return as_xml(document);
}

std::string as_sarif(const CheckReport& report) {
  Json results = Json::array();
  add_diagnostics(report.load_errors, report.sources, results);
  for (const CheckedAssertion& checked : report.assertions) {
    const base::Span span = checked.assertion->span;
    const std::string& text = checked.assertion->text;
    add_diagnostics(checked.diagnostics, report.sources, results);
    if (checked.result.outcome == Outcome::fails) {
      results.push_back(sarif_result("assertion-fails", "error",
                                     fmt::format("{} fails: {}", text, what_fails(checked)), span,
                                     report.sources));
      if (checked.result.witness) {
        results.back()["codeFlows"] = Json::array({code_flow(checked, report.sources)});
      }
    } else if (checked.result.outcome == Outcome::inconclusive) {
      results.push_back(
          sarif_result("assertion-inconclusive", "warning",
                       fmt::format("{} is inconclusive: {}", text, no_verdict_text(checked)), span,
                       report.sources));
    }
  }
  const auto rule = [](std::string_view id, std::string_view text) {
    return Json{{"id", id}, {"shortDescription", {{"text", text}}}};
  };
  const Json rules =
      Json::array({rule("assertion-fails", "An assertion of the script does not hold"),
                   rule("assertion-inconclusive", "A budget ran out before there was a verdict")});
  const Json document{
      {"$schema", "https://json.schemastore.org/sarif-2.1.0.json"},
      {"version", "2.1.0"},
      {"runs",
       Json::array(
           {{{"tool", {{"driver", {{"name", "perentie"}, {"version", version}, {"rules", rules}}}}},
             {"columnKind", "unicodeCodePoints"},
             {"results", std::move(results)}}})}};
  return text_of(document);
}

}  // namespace perentie::cli
