// Random finite processes: the traces of the step rules against a denotational calculation of
// traces from the syntax; laws of CSP on normal forms; sequence and set functions against std::.
//
// The denotation follows Roscoe, *The Theory and Practice of Concurrency*, chapters 2-6, with ✓ as
// an ordinary label at the end of a trace that parallels synchronise (CSPM reference 4.1.3).
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "canonical_form.hpp"
#include "perentie/test/lts_oracles.hpp"
#include "script_support.hpp"

namespace perentie::semantics {
namespace {

// --- Random processes with their traces ---------------------------------------------------------

using Trace = std::string;  // a letter an event, '!' is ✓
using Traces = std::set<Trace>;

struct Process {
  std::string text;
  Traces traces;
};

bool ends(const Trace& trace) { return !trace.empty() && trace.back() == '!'; }

// All merges of two traces that agree on the letters of `shared`; ✓ is always shared.
void merge(const Trace& a, const Trace& b, const std::string& shared, const Trace& done,
           Traces& out) {
  out.insert(done);
  const auto is_shared = [&](char c) { return c == '!' || shared.find(c) != std::string::npos; };
  if (!a.empty() && !is_shared(a[0])) merge(a.substr(1), b, shared, done + a[0], out);
  if (!b.empty() && !is_shared(b[0])) merge(a, b.substr(1), shared, done + b[0], out);
  if (!a.empty() && !b.empty() && a[0] == b[0] && is_shared(a[0])) {
    merge(a.substr(1), b.substr(1), shared, done + a[0], out);
  }
}

Traces parallel(const Traces& p, const Traces& q, const std::string& shared) {
  Traces out;
  for (const Trace& a : p) {
    for (const Trace& b : q) merge(a, b, shared, "", out);
  }
  return out;
}

// Traces of p that go on with one of q where `goes_on` says so.
template <class GoesOn>
Traces continued(const Traces& p, const Traces& q, bool keeps_end, GoesOn goes_on) {
  Traces out;
  for (const Trace& a : p) {
    if (keeps_end || !ends(a)) out.insert(a);
    if (!goes_on(a)) continue;
    const Trace before = ends(a) ? a.substr(0, a.size() - 1) : a;
    for (const Trace& b : q) out.insert(before + b);
  }
  return out;
}

Traces hidden(const Traces& p, char event) {
  Traces out;
  for (Trace t : p) {
    std::erase(t, event);
    out.insert(t);
  }
  return out;
}

Traces united(Traces p, const Traces& q) {
  p.insert(q.begin(), q.end());
  return p;
}

// Once `event` was performed, the rest is the handler's.
Traces excepted(const Traces& p, const Traces& handler, char event) {
  Traces out;
  for (const Trace& t : p) {
    const std::size_t at = t.find(event);
    if (at == Trace::npos) {
      out.insert(t);
    } else {
      for (const Trace& h : handler) out.insert(t.substr(0, at + 1) + h);
    }
  }
  return out;
}

Traces renamed(const Traces& p, char from, char to) {
  Traces out;
  for (Trace t : p) {
    std::replace(t.begin(), t.end(), from, to);
    out.insert(t);
  }
  return out;
}

Process random_process(int depth) {
  const auto pick = [](int end) { return *rc::gen::inRange(0, end); };
  const char event = "abc"[pick(3)];
  const std::string name(1, event);
  if (depth == 0) {
    return pick(2) == 0 ? Process{"STOP", {""}} : Process{"SKIP", {"", "!"}};
  }
  const Process p = random_process(depth - 1);
  const int kind = pick(12);
  if (kind < 3) {
    Traces traces{""};
    for (const Trace& t : p.traces) traces.insert(event + t);
    return {"(" + name + " -> " + p.text + ")", traces};
  }
  if (kind == 3) return {"(" + p.text + " \\ {" + name + "})", hidden(p.traces, event)};
  if (kind == 4) return {"(" + p.text + "[[" + name + " <- a]])", renamed(p.traces, event, 'a')};
  const Process q = random_process(depth - 1);
  const auto binary = [&](const std::string& op, Traces traces) {
    return Process{"(" + p.text + " " + op + " " + q.text + ")", std::move(traces)};
  };
  switch (kind) {
    case 5:
      return binary("[]", united(p.traces, q.traces));
    case 6:
      return binary("|~|", united(p.traces, q.traces));
    case 7:
      return binary("|||", parallel(p.traces, q.traces, ""));
    case 8:
      return binary("[|{" + name + "}|]", parallel(p.traces, q.traces, name));
    case 9:
      return binary(";", continued(p.traces, q.traces, false, ends));
    case 10:
      return binary("/\\",
                    continued(p.traces, q.traces, true, [](const Trace& t) { return !ends(t); }));
    default:
      return binary("[|{" + name + "}|>", excepted(p.traces, q.traces, event));
  }
}

Traces operational_traces(const lts::Lts& lts, std::size_t depth) {
  Traces traces;
  for (const test::Word& word : test::traces(lts, depth)) {
    Trace trace;
    for (const lts::Label label : word) {
      trace += label == lts::tick ? "!" : std::string(lts.name(label));
    }
    traces.insert(trace);
  }
  return traces;
}

RC_GTEST_PROP(SemanticsPropertyTest, OperationalTracesAreTheDenotedOnes, ()) {
  const Process process = random_process(4);
  TestScript script("channel a, b, c");
  const auto lts = script.explore(process.text);
  RC_ASSERT(lts.has_value());
  RC_PRE(lts->state_count() <= 64);
  constexpr std::size_t depth = 6;
  Traces denoted;
  for (const Trace& t : process.traces) {
    if (t.size() <= depth) denoted.insert(t);
  }
  RC_LOG() << process.text;
  RC_ASSERT(operational_traces(*lts, depth) == denoted);
}

// --- Laws ---------------------------------------------------------------------------------------

// P, Q and R stand for random processes.
struct Law {
  const char* left;
  const char* right;
};

RC_GTEST_PROP(SemanticsPropertyTest, LawsHoldInFailuresAndDivergences, ()) {
  static const std::vector<Law> laws{
      {"P [] Q", "Q [] P"},
      {"P [] P", "P"},
      {"P [] (Q [] R)", "(P [] Q) [] R"},
      {"P [] STOP", "P"},
      {"P |~| Q", "Q |~| P"},
      {"P |~| P", "P"},
      {"P |~| (Q |~| R)", "(P |~| Q) |~| R"},
      {"P [] (Q |~| R)", "(P [] Q) |~| (P [] R)"},
      {"P |~| (Q [] R)", "(P |~| Q) [] (P |~| R)"},
      {"P ||| Q", "Q ||| P"},
      {"P ||| (Q ||| R)", "(P ||| Q) ||| R"},
      {"P ||| SKIP", "P"},
      {"P [|{a}|] Q", "Q [|{a}|] P"},
      {"P [|{a}|] (Q |~| R)", "(P [|{a}|] Q) |~| (P [|{a}|] R)"},
      {"P [|{}|] Q", "P ||| Q"},
      {"(P ; Q) ; R", "P ; (Q ; R)"},
      {"SKIP ; P", "P"},
      {"STOP ; P", "STOP"},
      {"(P |~| Q) ; R", "(P ; R) |~| (Q ; R)"},
      {"(P \\ {a}) \\ {b}", "P \\ {a, b}"},
      {"(P |~| Q) \\ {a}", "(P \\ {a}) |~| (Q \\ {a})"},
      {"(a -> P) \\ {a}", "P \\ {a}"},
      {"P [> Q", "(P |~| STOP) [] Q"},
      {"P |\\ {a}", "P \\ {b, c}"},
      {"P [[a <- b]]", "P [[a <- b, c <- c]]"},
      {"P /\\ STOP", "P"},
      {"P [|{}|> Q", "P"},
  };
  const Law law = laws[*rc::gen::inRange<std::size_t>(0, laws.size())];
  TestScript script("channel a, b, c\nP = " + random_process(3).text +
                    "\nQ = " + random_process(2).text + "\nR = " + random_process(2).text);
  const auto left = script.explore(law.left);
  const auto right = script.explore(law.right);
  RC_LOG() << law.left << " = " << law.right;
  RC_ASSERT(left.has_value() && right.has_value());
  RC_ASSERT(failure_form(*left) == failure_form(*right));
  RC_ASSERT(trace_form(*left) == trace_form(*right));
}

// Each pair has the same traces but other failures, or other traces.
TEST(SemanticsPropertyTest, WhatAreNoLaws) {
  TestScript script("channel a, b, c");
  const auto form = [&](const char* process) { return failure_form(*script.explore(process)); };
  EXPECT_NE(form("a -> STOP [] b -> STOP"), form("a -> STOP |~| b -> STOP"));
  EXPECT_NE(form("a -> (b -> STOP |~| c -> STOP)"), form("a -> STOP [] a -> (b -> STOP |~| STOP)"));
  EXPECT_NE(form("((a -> STOP) [] SKIP) ; SKIP"), form("(a -> STOP) [] SKIP"));
  EXPECT_NE(form("a -> STOP ||| a -> STOP"), form("a -> STOP"));
  EXPECT_NE(form("(a -> STOP [] b -> STOP) \\ {a}"), form("STOP [] b -> STOP"));
  EXPECT_NE(form("SKIP [] a -> STOP"), form("SKIP [> a -> STOP"));
  EXPECT_NE(form("STOP ; DIV"), form("DIV"));
}

// --- Sequences and sets -------------------------------------------------------------------------

std::string text_of(const std::vector<int>& items, const char* open, const char* close) {
  std::string text = open;
  for (std::size_t i = 0; i < items.size(); ++i) {
    text += (i > 0 ? ", " : " ") + std::to_string(items[i]);
  }
  return text + close;
}

std::string shown(const std::set<int>& items) {
  std::string text = "{";
  for (const int item : items) text += (text.size() > 1 ? ", " : "") + std::to_string(item);
  return text + "}";
}

RC_GTEST_PROP(SemanticsPropertyTest, SetsAreTheStandardLibrarys, ()) {
  const auto element = rc::gen::inRange(-5, 6);
  const auto x = *rc::gen::container<std::vector<int>>(element);
  const auto y = *rc::gen::container<std::vector<int>>(element);
  const std::set<int> a(x.begin(), x.end()), b(y.begin(), y.end());
  std::set<int> all, both, less;
  std::set_union(a.begin(), a.end(), b.begin(), b.end(), std::inserter(all, all.end()));
  std::set_intersection(a.begin(), a.end(), b.begin(), b.end(), std::inserter(both, both.end()));
  std::set_difference(a.begin(), a.end(), b.begin(), b.end(), std::inserter(less, less.end()));
  const std::string s = text_of(x, "{", "}"), t = text_of(y, "{", "}");
  RC_ASSERT(value_of("union(" + s + ", " + t + ")") == shown(all));
  RC_ASSERT(value_of("inter(" + s + ", " + t + ")") == shown(both));
  RC_ASSERT(value_of("diff(" + s + ", " + t + ")") == shown(less));
  RC_ASSERT(value_of("card(" + s + ")") == std::to_string(a.size()));
  RC_ASSERT(value_of(s + " <= " + t) ==
            (std::includes(b.begin(), b.end(), a.begin(), a.end()) ? "true" : "false"));
}

}  // namespace
}  // namespace perentie::semantics
