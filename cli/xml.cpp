#include "xml.hpp"

#include <sstream>

#include <boost/property_tree/xml_parser.hpp>
#include <nlohmann/json.hpp>

namespace perentie::cli {

std::string as_xml(const boost::property_tree::ptree& tree) {
  std::ostringstream out;
  boost::property_tree::write_xml(
      out, tree, boost::property_tree::xml_writer_make_settings<std::string>(' ', 2));
  return std::move(out).str();
}

std::string xml_text(std::string_view text) {
  using Json = nlohmann::json;
  const std::string utf8 =
      Json::parse(Json(text).dump(-1, ' ', false, Json::error_handler_t::replace));
  std::string kept;
  for (const char c : utf8) {
    const auto byte = static_cast<unsigned char>(c);
    const bool is_control = byte < 0x20 && c != '\t' && c != '\n' && c != '\r';
    kept += is_control ? std::string("\xEF\xBF\xBD") : std::string(1, c);
  }
  return kept;
}

}  // namespace perentie::cli
