#include "model/keys.h"

#include <algorithm>

namespace whine {

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

}  // namespace whine
