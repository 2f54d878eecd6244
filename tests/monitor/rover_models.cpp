#include "rover_models.hpp"

#include <compare>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

namespace perentie::monitor {
namespace {

constexpr unsigned waypoints = 6;
constexpr unsigned all_waypoints = (1U << waypoints) - 1;

// A process term: the equation it stands in and its arguments. Rad is Green wherever it matters.
struct Term {
  std::string process;
  unsigned set = 0;
  unsigned waypoint = 0;

  friend auto operator<=>(const Term&, const Term&) = default;
};

struct Step {
  std::string event;
  Term target;
};

using Steps = std::vector<Step>;

std::string at(const std::string& channel, unsigned waypoint) {
  return channel + "." + std::to_string(waypoint);
}

void add_radiation(Steps& steps, const Term& green, const Term& danger) {
  steps.push_back({"radiation_level.Green", green});
  steps.push_back({"radiation_level.Orange", danger});
  steps.push_back({"radiation_level.Red", danger});
}

Steps paper_steps(const Term& term) {
  const Term abort{"ABORT"};
  Steps steps;
  if (term.process == "START") return {{"mission_start", {"ROVER", all_waypoints}}};
  if (term.process == "ABORT") return {{"move.0", {"ABORTED"}}};
  if (term.process == "ABORTED") return {{"mission_abort", {"SKIP"}}};
  if (term.process == "SKIP") return {{"✓", {"OMEGA"}}};
  if (term.process == "ROVER") {
    add_radiation(steps, term, abort);
    if (term.set == 0) steps.push_back({"mission_complete", {"SKIP"}});
    if ((term.set & 1U) != 0) steps.push_back({"move.0", {"ROVER", term.set & ~1U}});
    for (unsigned wp = 0; wp < waypoints; ++wp) {
      if ((term.set >> wp & 1U) != 0)
        steps.push_back({at("inspect", wp), {"INSPECTING", term.set, wp}});
    }
  }
  if (term.process == "INSPECTING") {
    add_radiation(steps, term, abort);
    steps.push_back({at("move", term.waypoint), {"ROVER", term.set & ~(1U << term.waypoint)}});
  }
  return steps;
}

Steps journal_steps(const Term& term) {
  const Term aborting{"ABORTING"};
  const auto next = [&term](const char* process) { return Term{process, term.set, term.waypoint}; };
  Steps steps;
  if (term.process == "ROVER") {
    for (unsigned wp = 0; wp < waypoints; ++wp)
      steps.push_back({at("move", wp), {"BEGINNING", term.set, wp}});
    add_radiation(steps, term, aborting);
  } else if (term.process == "BEGINNING") {
    steps.push_back({at("arrived_at", term.waypoint), next("MOVING")});
    add_radiation(steps, term, aborting);
  } else if (term.process == "MOVING") {
    steps.push_back({at("inspect", term.waypoint), next("INSPECTING")});
    add_radiation(steps, term, aborting);
  } else if (term.process == "INSPECTING") {
    const unsigned inspected = term.set | 1U << term.waypoint;
    steps.push_back({at("inspected", term.waypoint),
                     inspected == all_waypoints ? Term{"ENDING"} : Term{"ROVER", inspected}});
    add_radiation(steps, term, aborting);
  } else if (term.process == "ENDING") {
    steps.push_back({"mission_complete", {"SKIP"}});
    add_radiation(steps, term, aborting);
  } else if (term.process == "ABORTING") {
    // RAD_LOOP goes on until it takes part in move.0 and terminates.
    add_radiation(steps, term, term);
    steps.push_back({"move.0", {"LEFT"}});
  } else if (term.process == "LEFT") {
    steps.push_back({"mission_abort", {"SKIP"}});
  } else if (term.process == "SKIP") {
    steps.push_back({"✓", {"OMEGA"}});
  }
  return steps;
}

lts::Lts explore(const Term& initial, Steps (*steps_of)(const Term&)) {
  std::map<Term, lts::State> states;
  std::vector<Term> queue{initial};
  std::vector<std::vector<Step>> rows;
  std::set<std::string> events;
  states[initial] = lts::State{0};
  for (std::size_t i = 0; i < queue.size(); ++i) {
    rows.push_back(steps_of(queue[i]));
    for (const Step& step : rows.back()) {
      const lts::State fresh{static_cast<std::uint32_t>(queue.size())};
      if (states.emplace(step.target, fresh).second) queue.push_back(step.target);
      if (step.event != lts::tick_name) events.insert(step.event);
    }
  }
  lts::LabelNames names{std::string(lts::tau_name), std::string(lts::tick_name)};
  names.insert(names.end(), events.begin(), events.end());
  std::map<std::string, lts::Label> labels;
  for (std::uint32_t l = 0; l < names.size(); ++l) labels[names[l]] = lts::Label{l};

  lts::LtsBuilder builder(std::make_shared<const lts::LabelNames>(std::move(names)));
  builder.add_states(static_cast<std::uint32_t>(queue.size()));
  for (std::uint32_t s = 0; s < rows.size(); ++s) {
    for (const Step& step : rows[s]) {
      builder.add_edge(lts::State{s}, labels.at(step.event), states.at(step.target));
    }
  }
  return std::move(builder).finish(lts::State{0});
}

}  // namespace

lts::Lts paper_rover() { return explore({"START"}, paper_steps); }

lts::Lts journal_rover() { return explore({"ROVER"}, journal_steps); }

}  // namespace perentie::monitor
