#include "io/rexs_json.h"

#include <jsoncpp/json/json.h>

#include <memory>

#include "io/rexs_archive.h"

namespace whine {

Json::Value rexs_json(const std::string& path, const std::string& bytes) {
  Json::CharReaderBuilder builder;
  builder["collectComments"] = false;
  Json::Value document;
  std::string why;
  const std::unique_ptr<Json::CharReader> reader(builder.newCharReader());
  if (!reader->parse(bytes.data(), bytes.data() + bytes.size(), &document, &why))
    reject_rexs(path, "its JSON is broken: " + why.substr(why.find_first_not_of("* \n")));
  if (!document.isObject() || !document["model"].isObject()) reject_rexs(path, "its JSON holds no \"model\"");
  return document;
}

}  // namespace whine
