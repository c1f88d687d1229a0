// What components and load case of a REXS model give for attributes, with its origin. Notes what was read.
//
// Private to the layer io/.
#pragma once
#include <array>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "base/units.h"
#include "io/rexs/rexs.h"

namespace whine {

enum class RexsDimension { number, length, angle, pressure, density, moment, frequency, power };
struct RexsUnit {
  const char* word;  // without blanks
  RexsDimension dimension;
  double si;
};
inline constexpr RexsUnit kRexsNumber{"", RexsDimension::number, 1};
// What keys of a scene are in.
inline constexpr RexsUnit kRexsMicrometre{"mum", RexsDimension::length, 1e-6},
    kRexsMillimetre{"mm", RexsDimension::length, 1e-3}, kRexsDegree{"deg", RexsDimension::angle, kOneDegree},
    kRexsGigapascal{"GPa", RexsDimension::pressure, 1e9}, kRexsDensity{"kg/m^3", RexsDimension::density, 1},
    kRexsNewtonMetre{"Nm", RexsDimension::moment, 1},
    kRexsPerMinute{"1/min", RexsDimension::frequency, 1.0 / 60}, kRexsWatt{"W", RexsDimension::power, 1};

struct RexsNumber {
  double value = 0;      // in the unit that was asked for
  std::string origin;    // component and attribute; of an assumed one why it is that
  bool assumed = false;  // not said by the model, or derived from what it says of something else
};

// Type, id and name for a comment of TOML or a message: one line of printable text.
std::string quoted_name(const RexsComponent& c);

// A number with not more than so many significant digits.
double with_digits(double value, int digits);

class RexsReader {
 public:
  // load_case: see scene_of_rexs. Keeps a reference to the model. Throws Error(input).
  RexsReader(const RexsModel& model, int load_case);

  const RexsModel& model() const { return model_; }
  const RexsComponent& component(int id) const { return model_.components.at(id); }
  const std::string& path() const { return model_.path; }

  // The first component of a type that stands in a relation with `id`; nullptr: none.
  const RexsComponent* beside(int id, const std::string& type) const;
  // Components that stand in a relation with `id`.
  std::vector<const RexsComponent*> related(int id) const;
  // role: left, right. nullptr: none.
  const RexsComponent* flank(int gear, const std::string& role) const;
  // What a stage says of a gear; nullptr: nothing.
  const RexsComponent* stage_gear_data(int stage, int gear) const;

  // The value of an attribute: as the load case has it, else as the component has it. Number: in `unit`; empty where there is
  // none; Error(input) for what is no finite number of a known unit. Word: without blanks around it; empty where there is none.
  // c may be nullptr.
  std::optional<RexsNumber> number(const RexsComponent* c, const std::string& attribute,
                                   const RexsUnit& unit);
  RexsNumber required(const RexsComponent& c, const std::string& attribute, const RexsUnit& unit);
  // A list of three; empty where there is none.
  std::optional<std::array<double, 3>> vector(const RexsComponent* c, const std::string& attribute,
                                              const RexsUnit& unit);
  // Of the flanks of a gear, which must agree where both say it.
  std::optional<RexsNumber> of_flanks(int gear, const std::string& attribute, const RexsUnit& unit);
  std::string word(const RexsComponent* c, const std::string& attribute);
  // Of a list; its one word where it is none.
  std::vector<std::string> words(const RexsComponent* c, const std::string& attribute);
  // Error(input) for what is neither true nor false.
  std::optional<bool> flag(const RexsComponent* c, const std::string& attribute);

  // Attributes that were not read, of components and load case, where any was read of the component; results are left out.
  std::vector<std::string> unread() const;

 private:
  struct Found {
    const RexsAttribute* attribute = nullptr;
    std::string origin = {};
  };
  Found found(const RexsComponent* c, const std::string& attribute);
  double value_of(const RexsComponent& c, const std::string& attribute, const std::string& given,
                  const std::string& of_unit, const RexsUnit& unit) const;
  const RexsAttribute* attribute_of(const RexsComponent& c, const std::string& name, bool of_load) const;

  const RexsModel& model_;
  const std::map<int, RexsComponent>* load_ = nullptr;
  std::map<int, std::set<std::string>> read_;  // by component
};

}  // namespace whine
