#include "io/stage_parameters_text.h"

#include <filesystem>

namespace whine {
namespace {

constexpr std::size_t kMostRows = 1000;

// Section of stage parameters that holds a key.
std::string stage_section(const Key& key) {
  if (key.own.empty()) return key.section;
  return key.own[0] == '_' ? key.own.substr(1) : key.own;
}

// A file of sections [gear.<name>], which stage parameters have none of.
bool is_scene(const Source& source) {
  const toml::table* gears = source.root()["gear"].as_table();
  return gears &&
         std::any_of(gears->begin(), gears->end(), [](const auto& own) { return own.second.is_table(); });
}

}  // namespace

Source stage_source(const std::string& path, const StageFile& file, const StageFile& other) {
  const std::string below = "/" + std::string(file.path);
  Source source(path, "stage parameters are out/<scene>" + below + ", made with: make out/<scene>" + below);
  if (!source.is_stage_parameters() && is_scene(source)) {
    const std::string settings = "out/" + std::filesystem::path(path).stem().string() + below;
    source.reject(
        "is a whole scene; this stage reads the stage parameters that gear-scene writes from it: give ",
        settings, " (make SCENE=", path, " ", settings, ")");
  }
  if (source.is_stage_parameters() && source.stage_of() != file.stage && source.stage_of() != other.stage)
    source.reject("is what ", source.stage_of(), " depends on, and this stage reads what ", file.stage,
                  " depends on: give out/<scene>", below);
  return source;
}

StageParameters::StageParameters(const StageFile& file) {
  out_ << kStageParametersStart << file.stage << kStageParametersEnd << "\n";
}

bool StageParameters::has(const std::string& section, bool there) const {
  return source_ ? source_->section(section) != nullptr : there;
}

void StageParameters::begin(const std::string& section) {
  if (section != last_) out_ << "\n[" << section << "]\n";
  last_ = section;
}

void StageParameters::operator()(const KeyList& keys) {
  if (source_) return read(keys);
  for (const Key& key : keys) {
    if (!is_held(key)) continue;
    begin(stage_section(key));
    const std::string value = exact_value(key, "\"");
    out_ << key.si_name() << " = " << value;
    if (std::string(key.unit.si) != "1" && value != "true" && value != "false") out_ << "  # " << key.unit.si;
    out_ << "\n";
  }
}

void StageParameters::read(const KeyList& keys) const {
  const auto has = [&](const Key& key) {
    const toml::table* table = source_->section(stage_section(key));
    return table && table->contains(key.si_name());
  };
  read_held(keys, has, stage_section, [&](const std::string& section, const KeyList& own) {
    const toml::table* table = source_->section(section);
    if (!table)
      source_->reject(
          "lacks the section [", section, "]: ",
          source_->is_stage_parameters()
              ? "it holds the parameters of another stage, or old ones; give out/<scene>/params/<stage>.toml"
              : "it holds no stage parameters; gear-scene writes them from a scene, out/<scene>/params/<stage>.toml");
    SectionReader(*source_, *table, own.begin()->section, section, "", Dialect::settings).read(own);
  });
}

void StageParameters::word(const std::string& section, const std::string& name, std::string& word) {
  if (source_) {
    word = source_->root()[section][name].value_or(std::string());
  } else {
    begin(section);
    out_ << name << " = \"" << word << "\"\n";
  }
}

void StageParameters::words(const std::string& section, Words& words) {
  if (source_) {
    const toml::table* table = source_->section(section);
    if (!table) source_->reject("lacks the section [", section, "]; it is made by gear-scene");
    words.clear();
    for (const auto& [name, word] : *table) words.emplace_back(name.str(), word.value_or(std::string()));
    std::stable_sort(words.begin(), words.end(), [&](const auto& a, const auto& b) {
      return table->get(a.first)->source().begin.line < table->get(b.first)->source().begin.line;
    });
  }
  for (auto& [name, own] : words)
    if (!source_) word(section, name, own);
}

std::vector<const toml::table*> StageParameters::rows(const char* name) const {
  if (!source_) return {};
  const std::vector<const toml::table*> rows = source_->list(name);
  if (rows.size() > kMostRows)
    source_->reject(*rows[0], "'", name, "' lists more than ", kMostRows, " sections");
  return rows;
}

// In a row names have no unit to lose, and its ranges hold.
void StageParameters::read_row(const toml::table& row, const char* name, const KeyList& keys) const {
  SectionReader(*source_, row, name, name).read(keys);
}

void StageParameters::put_row(const char* name, const KeyList& keys) {
  out_ << "\n[[" << name << "]]\n";
  for (const Key& key : keys) out_ << key.name << " = " << exact_value(key, "\"") << "\n";
}

KeyList level_keys(Fidelity& fidelity, ContactDiscretisation& contact, TimeDiscretisation* moving) {
  KeyList out = moving ? keys(fidelity) : keys(fidelity).only({"contact", "width"});
  out.append(keys(contact));
  return moving ? out.append(keys(*moving)) : out;
}

}  // namespace whine
