// Repl: what the prompt does with a line. Reading lines is the caller's part (command_repl.cpp).
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "console.hpp"
#include "model.hpp"
#include "perentie/semantics/assertions.hpp"

namespace perentie::cli {

class Repl {
 public:
  /// `call_stack`: errors are shown with the calls that led to them.
  Repl(const BudgetOptions& budget, bool call_stack, Console& console)
      : budget_(budget), call_stack_(call_stack), console_(console) {}

  /// Loads a script and forgets the session's definitions. False if it has errors, which are
  /// printed; the session is then empty (CSPM reference 8.3).
  bool load(const std::string& path);
  /// Answers one line. False: the user wants to leave.
  bool answer(std::string_view line);
  /// What a word that is being typed may become: commands after `:`, names of the session.
  std::vector<std::string> completions(std::string_view word) const;
  /// The script's name, for the prompt.
  std::string name() const;

 private:
  struct Session {
    Input input;
    std::unique_ptr<semantics::Script> script;
    std::vector<semantics::ScriptAssertion> assertions;  // the script's, then those of the user
  };

  void forget_diagnostics(Input& input);
  void open(std::unique_ptr<Session> session);
  void evaluate(const std::string& expression);
  void show_type(const std::string& expression);
  void define(const std::string& definitions);
  void claim(const std::string& assertion);
  void run(const std::string& number);
  void show_processes();
  void show_assertions();
  void help() const;
  bool command(std::string_view line);
  std::string in_scope(const std::string& expression) const;
  std::string assertion_in_scope(const std::string& text) const;
  void report(bool answered);

  const BudgetOptions& budget_;
  bool call_stack_;
  Console& console_;
  std::string path_;
  std::unique_ptr<Session> session_;
  std::vector<std::string> definitions_;  // of `let`, each in the scope of those before it
};

}  // namespace perentie::cli
