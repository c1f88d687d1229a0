#include "io/rexs/json.h"

#include <jsoncpp/json/json.h>

#include <memory>

#include "base/error.h"
#include "io/rexs/archive.h"

namespace whine {

Json::Value rexs_json(const std::string& path, const std::string& bytes) {
  Json::CharReaderBuilder builder;
  builder["collectComments"] = false;
  builder["rejectDupKeys"] = true;
  builder["stackLimit"] = static_cast<Json::UInt>(kMostRexsDepth);
  Json::Value document;
  std::string why;
  const std::unique_ptr<Json::CharReader> reader(builder.newCharReader());
  try {
    if (!reader->parse(bytes.data(), bytes.data() + bytes.size(), &document, &why))
      reject_rexs(path, "its JSON is broken: " + why.substr(why.find_first_not_of("* \n")));
  } catch (const Json::Exception&) {
    // The only one that the parser throws.
    reject_rexs(path, text("its JSON is nested deeper than ", kMostRexsDepth));
  }
  if (!document.isObject() || !document["model"].isObject()) reject_rexs(path, "its JSON holds no \"model\"");
  return document;
}

}  // namespace whine
