#include "peer_rows.hpp"

#include <fstream>
#include <map>
#include <memory>
#include <sstream>

namespace perentie::semantics {

void for_each_peer(const std::filesystem::path& data,
                   const std::function<void(const PeerRow&, TestScript&)>& use) {
  std::ifstream table(data / "peer-normal-forms.tsv");
  ASSERT_TRUE(table);
  std::map<std::string, std::unique_ptr<TestScript>> scripts;
  std::string line;
  std::getline(table, line);  // the heading
  while (std::getline(table, line)) {
    std::istringstream text(line);
    PeerRow row;
    std::getline(text, row.file, '\t');
    std::getline(text, row.process, '\t');
    text >> row.states >> row.transitions >> row.traces.nodes >> row.traces.hash >>
        row.failures.nodes >> row.failures.hash;
    ASSERT_TRUE(text) << line;
    SCOPED_TRACE(row.file + " " + row.process);
    auto& script = scripts[row.file];
    if (!script) script = TestScript::of_file(data / row.file);
    ASSERT_TRUE(script->loaded()) << script->messages();
    use(row, *script);
  }
}

}  // namespace perentie::semantics
