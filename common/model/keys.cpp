#include "model/keys.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

namespace whine {

Value Key::value() const {
  return std::visit(Overloaded{[](const auto* held) -> Value { return *held; },
                               [](const CornerRule* rule) -> Value {
                                 if (!rule->enabled || std::isinf(rule->largest_angle)) return rule->enabled;
                                 return rule->largest_angle;
                               },
                               [](const RangeSlot& range) -> Value {
                                 return std::vector<double>{*range.from, *range.to, *range.step};
                               },
                               [&](const ChoiceSlot& choice) -> Value {
                                 const int place = choice.place(choice.value);
                                 if (!*choices) return place;
                                 return word_at(choices, place);
                               }},
                    slot);
}

void Key::take_fallback() const {
  const std::string word(fallback);
  std::visit(Overloaded{[&](double* held) { *held = to_si(std::strtod(fallback, nullptr)); },
                        [&](int* held) { *held = static_cast<int>(std::strtol(fallback, nullptr, 10)); },
                        [&](bool* held) { *held = word == "true"; }, [&](std::string* held) { *held = word; },
                        [&](const ChoiceSlot& choice) { assign(choice, word); },
                        [&](CornerRule* rule) { *rule = {word == "true"}; }, [](const RangeSlot&) {},
                        [](auto* list) { list->clear(); }},
             slot);
}

std::string Unit::in_words() const {
  return *spelt ? spelt : *suffix ? suffix + 1 : "";
}

std::string Key::si_name() const {
  const std::string whole(name), suffix(unit.suffix);
  return whole.substr(0, whole.size() - suffix.size());
}

Key& KeyList::add(Slot slot, const char* name, const Unit& unit, const char* fallback, const Limits& limits,
                  const char* meaning) {
  Key key{section_, name, unit, fallback, limits, meaning, slot};
  key.own = own_;
  key.group = group_;
  key.stands = stands_;
  return keys_.emplace_back(std::move(key));
}

void KeyList::begin_group(bool stands, const std::string& own) {
  group_ = ++groups_;
  stands_ = stands;
  own_ = own;
}

KeyList& KeyList::append(const KeyList& other) {
  for (Key key : other) {
    if (key.group > 0) key.group += groups_;
    keys_.push_back(std::move(key));
  }
  groups_ += other.groups_;
  return *this;
}

void KeyList::append_group(const KeyList& other, bool stands, const std::string& own) {
  begin_group(stands, own);
  for (Key key : other) {
    key.group = group_;
    key.stands = stands;
    key.own = own;
    keys_.push_back(std::move(key));
  }
}

template <class Takes>
KeyList KeyList::those(const Takes& takes) const {
  KeyList out = *this;
  std::erase_if(out.keys_, [&](const Key& key) { return !takes(key); });
  return out;
}

KeyList KeyList::section(const std::string& section) const {
  return those([&](const Key& key) { return key.section == section; });
}

KeyList KeyList::only(std::initializer_list<const char*> names) const {
  return those([&](const Key& key) {
    return std::any_of(names.begin(), names.end(), [&](const char* name) { return key.called(name); });
  });
}

KeyList KeyList::without(std::initializer_list<const char*> names) const {
  return those([&](const Key& key) {
    return std::none_of(names.begin(), names.end(), [&](const char* name) { return key.called(name); });
  });
}

KeyList KeyList::plain() const {
  return those([](const Key& key) { return key.group == 0; });
}

KeyList KeyList::all() const {
  KeyList out = *this;
  for (Key& key : out.keys_) {
    key.group = 0;
    key.stands = true;
    key.unless = nullptr;
  }
  return out;
}

KeyList KeyList::labelled(const std::string& own) const {
  KeyList out = *this;
  for (Key& key : out.keys_) key.own = own;
  return out;
}

void take_module(const KeyList& keys, double module) {
  const std::string start = "module / ";
  for (const Key& key : keys)
    if (const std::string word(key.fallback ? key.fallback : ""); word.starts_with(start))
      if (double& value = *std::get<double*>(key.slot); value == 0)
        value = module / std::strtod(word.c_str() + start.size(), nullptr);
}

}  // namespace whine
