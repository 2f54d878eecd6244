// XML documents from property trees; the only place that knows Boost's writer.
#pragma once

#include <string>
#include <string_view>

#include <boost/property_tree/ptree.hpp>

namespace perentie::cli {

/// The document with its declaration, indented.
std::string as_xml(const boost::property_tree::ptree& tree);
/// The text without the control characters that no XML document can hold.
std::string xml_text(std::string_view text);

}  // namespace perentie::cli
