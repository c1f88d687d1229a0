// One cylindrical stage of a REXS model: its two gears, the driver first, and the values that components and load case give for
// attributes. Notes what was read.
//
// Private to the layer io/.
#pragma once
#include <array>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "io/rexs.h"

namespace whine {

enum class RexsDimension { number, length, angle, pressure, density, moment, frequency };
struct RexsUnit {
  const char* word;  // without blanks
  RexsDimension dimension;
  double si;
};
inline constexpr RexsUnit kRexsNumber{"", RexsDimension::number, 1};

struct RexsNumber {
  double value;        // in the unit that was asked for
  std::string origin;  // component and attribute
};

// Type, id and name for a comment of TOML or a message: one line of printable text.
std::string quoted_name(const RexsComponent& c);

class RexsStage {
 public:
  // wanted, load_case: see scene_of_rexs. Keeps a reference to the model. Throws Error(input).
  RexsStage(const RexsModel& model, const std::string& wanted, int load_case);

  const RexsComponent& component(int id) const { return model_.components.at(id); }
  const RexsComponent& stage() const { return component(id_); }
  // side: 0 driver, 1 driven
  const RexsComponent& gear(int side) const { return component(gear_[static_cast<size_t>(side)]); }
  // Why the driver is the one that it is; empty: the model says so.
  const std::string& driver_assumed() const { return driver_assumed_; }
  const std::string& path() const { return model_.path; }

  // The first component of a type that stands in a relation with `id`; nullptr: none.
  const RexsComponent* beside(int id, const std::string& type) const;
  // Components that stand in a relation with `id`.
  std::vector<const RexsComponent*> related(int id) const;
  // role: left, right. nullptr: none.
  const RexsComponent* flank(int side, const std::string& role) const;
  // What the stage says of a gear; nullptr: nothing.
  const RexsComponent* stage_gear_data(int side) const;

  // The value of an attribute: as the load case has it, else as the component has it. Number: in `unit`; empty where there is
  // none; Error(input) for what is no finite number of a known unit. Word: without blanks around it; empty where there is none.
  // c may be nullptr.
  std::optional<RexsNumber> number(const RexsComponent* c, const std::string& attribute,
                                   const RexsUnit& unit);
  RexsNumber required(const RexsComponent* c, const RexsComponent& owner, const std::string& attribute,
                      const RexsUnit& unit);
  // Of both flanks of a gear, which must agree.
  RexsNumber of_flanks(int side, const std::string& attribute, const RexsUnit& unit);
  std::string word(const RexsComponent* c, const std::string& attribute);

  // Attributes that were not read, of components and load case, where any was read of the component; results are left out.
  std::vector<std::string> unread() const;

 private:
  int choose(const std::string& wanted) const;
  void put_driver_first();
  const RexsAttribute* attribute_of(const RexsComponent& c, const std::string& name, bool of_load) const;
  std::optional<bool> flag(const RexsComponent* c, const std::string& attribute);

  const RexsModel& model_;
  const std::map<int, RexsComponent>* load_ = nullptr;
  int id_ = -1;
  std::array<int, 2> gear_ = {-1, -1};
  std::map<int, std::set<std::string>> read_;  // by component
  std::string driver_assumed_;
};

}  // namespace whine
