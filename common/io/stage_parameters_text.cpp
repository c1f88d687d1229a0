#include "io/stage_parameters_text.h"

#include <cmath>

namespace whine {
namespace {

std::string quoted_text(const std::string& word) {
  std::string out = "\"";
  for (char c : word) {
    if (c == '"' || c == '\\') out += '\\';
    out += c;
  }
  return out + "\"";
}

std::string value_of(const Key& key) {
  const Slot& slot = key.slot;
  if (const auto* number = std::get_if<double*>(&slot)) return exact_text(**number);
  if (const auto* whole = std::get_if<int*>(&slot)) return std::to_string(**whole);
  if (const auto* flag = std::get_if<bool*>(&slot)) return **flag ? "true" : "false";
  if (const auto* word = std::get_if<std::string*>(&slot)) return quoted_text(**word);
  if (const auto* choice = std::get_if<ChoiceSlot>(&slot)) return quoted_text(key.word_in(*choice));
  if (const auto* plane = std::get_if<PlaneSlot>(&slot)) return *plane->stress ? "\"stress\"" : "\"strain\"";
  if (const auto* corner = std::get_if<CornerRule*>(&slot)) {
    if (!(*corner)->enabled) return "false";
    return std::isfinite((*corner)->largest_angle) ? exact_text((*corner)->largest_angle) : "true";
  }
  if (const auto* list = std::get_if<std::vector<double>*>(&slot)) return exact_text(**list);
  if (const auto* points = std::get_if<Points*>(&slot)) return exact_text(**points);
  if (const auto* teeth = std::get_if<ToothList>(&slot)) return exact_text(*teeth->values);
  const auto& range = std::get<RangeSlot>(slot);
  return "{ from = " + exact_text(*range.from) + ", to = " + exact_text(*range.to) +
         ", step = " + exact_text(*range.step) + " }";
}

}  // namespace

std::string stage_label(const Key& key) {
  if (key.own.empty()) return key.section;
  return key.own[0] == '_' ? key.own.substr(1) : key.own;
}

StageParametersText::StageParametersText(const std::string& stage) {
  out_ << kStageParametersStart << stage << kStageParametersEnd << "\n";
}

void StageParametersText::begin(const std::string& label) {
  if (label != last_) out_ << "\n[" << label << "]\n";
  last_ = label;
}

void StageParametersText::add(const KeyList& keys) {
  for (const Key& key : keys) {
    if (!is_held(key)) continue;
    begin(stage_label(key));
    const std::string value = value_of(key);
    out_ << key.si_name() << " = " << value;
    if (std::string(key.unit.si) != "1" && value != "true" && value != "false") out_ << "  # " << key.unit.si;
    out_ << "\n";
  }
}

void StageParametersText::add_line(const std::string& label, const std::string& name,
                                   const std::string& word) {
  begin(label);
  out_ << name << " = " << quoted_text(word) << "\n";
}

void read_stage(const Source& source, const KeyList& keys) {
  const auto has = [&](const Key& key) {
    const toml::table* table = source.section(stage_label(key));
    return table && table->contains(key.si_name());
  };
  read_held(keys, has, stage_label, [&](const std::string& label, const KeyList& own) {
    const toml::table* table = source.section(label);
    if (!table)
      source.reject(whine::text(
          "lacks the section [", label, "]: ",
          source.is_stage_parameters()
              ? "it holds the parameters of another stage, or old ones; give out/<scene>/params/<stage>.toml"
              : "it holds no stage parameters; gear-scene writes them from a scene, out/<scene>/params/<stage>.toml"));
    SectionReader(source, Dialect::settings, *table, own.begin()->section, label).read(own);
  });
}

}  // namespace whine
