#include <unordered_map>

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>
#include <nlohmann/json.hpp>

#include "fdr_report.hpp"
#include "xml.hpp"

namespace perentie::cli {
namespace {

using Json = nlohmann::ordered_json;
using boost::property_tree::ptree;
using semantics::Behaviour;
using semantics::CheckResult;

class EventNumbers {
 public:
  EventNumbers() { map_ = {{"0", "0"}, {"1", lts::tau_name}, {"2", lts::tick_name}}; }

  std::size_t number(const std::string& event) {
    if (event.empty()) return 0;
    if (event == lts::tau_name) return 1;
    if (event == lts::tick_name) return 2;
    const auto [found, is_new] = numbers_.try_emplace(event, numbers_.size() + 3);
    if (is_new) map_[std::to_string(found->second)] = event;
    return found->second;
  }
  Json numbers(const std::vector<std::string>& events) {
    Json list = Json::array();
    for (const std::string& event : events) list.push_back(number(event));
    return list;
  }
  const Json& map() const { return map_; }

 private:
  std::unordered_map<std::string, std::size_t> numbers_;
  Json map_;
};

class Document {
 public:
  Document(const FdrReport& report, const FdrLayout& layout) : report_(report), layout_(layout) {}

  Json json() {
    Json results = Json::array();
    for (const CheckedAssertion& checked : report_.assertions) results.push_back(result(checked));
    Json prints = Json::array();
    for (const PrintedValue& printed : report_.prints) prints.push_back(print(printed));
    return {{"results", std::move(results)},
            {"print_statement_results", std::move(prints)},
            {"file_name", report_.file},
            {"event_map", has_counterexamples_ ? events_.map() : Json::object()},
            {"warnings", messages(base::Severity::warning)},
            {"errors", messages(base::Severity::error)}};
  }

 private:
  Json messages(base::Severity severity) const {
    return fdr_messages(report_.load_diagnostics, severity, report_.sources);
  }

  // With the word `print` before the expression, which is all that the span has.
  base::Span statement_of(const semantics::ScriptPrint& print) const {
    const std::string_view line = report_.sources.line_at(print.span.begin);
    const std::size_t word = line.find("print");
    const std::size_t expression = line.find(print.text, word == line.npos ? 0 : word);
    if (word == line.npos || expression == line.npos) return print.span;
    return {print.span.begin - static_cast<base::Offset>(expression - word), print.span.end};
  }

  Json print(const PrintedValue& printed) const {
    return {{"print_statement", printed.print->text},
            {"location", fdr_location(statement_of(*printed.print), report_.sources)},
            {"errors", fdr_errors(printed, report_.sources)},
            {"result", printed.value.value_or("")}};
  }

  Json result(const CheckedAssertion& checked) {
    const CheckResult& result = checked.result;
    Json json{{"assertion_string", checked.assertion->text},
              {"errors", fdr_errors(checked, report_.sources)}};
    if (!json["errors"].empty()) return json;
    json["is_negated"] = checked.assertion->assertion.negated ? 1 : 0;
    json["result"] = result.outcome == CheckResult::Outcome::holds ? 1 : 0;
    json["visited_states"] = result.counts.states;
    json["visited_transitions"] = result.counts.transitions;
    json["visited_plys"] = result.counts.plys;
    json["counterexamples"] = Json::array();
    const auto found = layout_.counterexamples ? fdr_counterexample(checked) : std::nullopt;
    if (!found) return json;
    has_counterexamples_ = true;
    Json counterexample{{"type", found->type}};
    if (found->specification) {
      counterexample["specification_behaviour"] = behaviour(*found->specification);
    }
    counterexample["implementation_behaviour"] = behaviour(found->implementation);
    if (layout_.reveal_taus) {
      counterexample["implementation_behaviour"]["revealed_trace"] =
          events_.numbers(found->revealed_trace);
    }
    json["counterexamples"].push_back(std::move(counterexample));
    return json;
  }

  // Recursion is as deep as the components nest, which is bounded.
  Json behaviour(const Behaviour& b) {
    Json json = Json::object();
    if (!b.name.empty()) json["machine_name"] = b.name;
    json["type"] = fdr_type(b.kind);
    if (b.kind == Behaviour::Kind::trace) json["error_event"] = events_.number(b.event);
    if (b.kind == Behaviour::Kind::loop) json["loop_start"] = b.loop_start;
    if (b.kind == Behaviour::Kind::acceptance) json["acceptance"] = events_.numbers(b.acceptance);
    json["trace"] = events_.numbers(b.trace);
    if (!b.states.empty()) {
      Json states = Json::array();
      for (const Behaviour::State& state : b.states) {
        states.push_back(state.is_named ? state.term : "<unnamed>");
      }
      json["states"] = std::move(states);
    }
    if (layout_.divide && !b.components.empty()) {
      for (const Behaviour& component : b.components) {
        json["child_behaviours"].push_back(behaviour(component));
      }
    }
    return json;
  }

  const FdrReport& report_;
  const FdrLayout& layout_;
  EventNumbers events_;
  bool has_counterexamples_ = false;
};

// As FDR writes strings: `/` as `\/`, which stands in strings alone.
std::string as_json(const Json& json) {
  std::string text;
  for (const char c : json.dump(-1, ' ', false, Json::error_handler_t::replace)) {
    if (c == '/') text += '\\';
    text += c;
  }
  return text + '\n';
}

void emit(const Json& json, YAML::Emitter& out) {
  if (json.is_object()) {
    out << YAML::BeginMap;
    for (const auto& [key, value] : json.items()) {
      out << YAML::Key << key << YAML::Value;
      emit(value, out);
    }
    out << YAML::EndMap;
  } else if (json.is_array()) {
    const bool is_plain =
        std::all_of(json.begin(), json.end(), [](const Json& j) { return j.is_number(); });
    out << (is_plain ? YAML::Flow : YAML::Block) << YAML::BeginSeq;
    for (const Json& item : json) emit(item, out);
    out << YAML::EndSeq;
  } else if (json.is_string()) {
    out << YAML::DoubleQuoted << json.get<std::string>();
  } else {
    out << json.get<std::uint64_t>();
  }
}

std::string as_yaml(const Json& json) {
  YAML::Emitter out;
  emit(json, out);
  return std::string(out.c_str()) + '\n';
}

// Keys that are numbers begin with `i_` (7.3.10); the elements of a list are `item`s.
ptree tree_of(const Json& json) {
  ptree tree;
  if (json.is_object()) {
    for (const auto& [key, value] : json.items()) {
      const bool is_number = key.find_first_not_of("0123456789") == std::string::npos;
      tree.push_back({(is_number ? "i_" : "") + key, tree_of(value)});
    }
  } else if (json.is_array()) {
    for (const Json& item : json) tree.push_back({"item", tree_of(item)});
  } else if (json.is_string()) {
    tree.data() = xml_text(json.get<std::string>());
  } else {
    tree.data() = json.dump();
  }
  return tree;
}

}  // namespace

std::string fdr_document(const FdrReport& report, const FdrLayout& layout, FdrDocument form) {
  const Json json = Document(report, layout).json();
  switch (form) {
    case FdrDocument::json:
      return as_json(json);
    case FdrDocument::yaml:
      return as_yaml(json);
    case FdrDocument::xml: {
      ptree document;
      document.push_back({"file", tree_of(json)});
      return as_xml(document);
    }
  }
  return {};
}

}  // namespace perentie::cli
