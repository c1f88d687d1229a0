#include "report/compare.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "base/error.h"
#include "io/scene_keys.h"
#include "model/response_quantities.h"
#include "report/figure_words.h"
#include "report/figures.h"
#include "report/html.h"
#include "report/report_geometry.h"
#include "report/report_page.h"
#include "report/report_remarks.h"
#include "report/report_results.h"
#include "report/system_report_tables.h"
#include "signal/result_quantities.h"

namespace whine {
namespace {

constexpr const char* kStar = " *";  // behind a value of a motion beyond the backlash

// Nothing for what is no single number, such as a list of jumps.
bool is_number(const std::string& words, double& value) {
  char* end = nullptr;
  value = std::strtod(words.c_str(), &end);
  return !words.empty() && *end == '\0' && std::isfinite(value);
}

void add_changes(Difference& row) {
  double first = 0, other = 0;
  const bool number = is_number(row.value[0], first) && first != 0;
  for (size_t d = 1; d < row.value.size(); ++d) {
    const bool both = number && is_number(row.value[d], other);
    const double change = both ? (other / first - 1) * kPercent : 0;
    row.change.push_back(both && row.unit != "%" ? (change > 0 ? "+" : "") + fixed(change, 1) : "");
  }
}

// Rows in the order in which quantities come, of the first design that has them.
class Rows {
 public:
  explicit Rows(size_t designs) : designs_(designs) {}
  void put(size_t design, const std::string& part, const std::string& quantity, const std::string& unit,
           const std::string& value) {
    auto row = std::find_if(rows_.begin(), rows_.end(), [&](const Difference& r) {
      return r.part == part && r.quantity == quantity && r.unit == unit;
    });
    if (row == rows_.end()) {
      rows_.push_back({part, quantity, unit, std::vector<std::string>(designs_, html::kNoValue), {}});
      row = rows_.end() - 1;
    }
    row->value[design] = value;
  }
  // Those that are not the same everywhere.
  std::vector<Difference> differing() {
    std::erase_if(rows_, [](const Difference& row) {
      return std::all_of(row.value.begin(), row.value.end(),
                         [&](const std::string& value) { return value == row.value[0]; });
    });
    for (Difference& row : rows_) add_changes(row);
    return std::move(rows_);
  }

 private:
  size_t designs_;
  std::vector<Difference> rows_;
};

std::vector<double> common_torques(const std::vector<Design>& designs) {
  std::vector<double> out;
  for (const StaticResult& s : designs.at(0).content.statics)
    if (std::all_of(designs.begin(), designs.end(), [&](const Design& d) {
          return std::any_of(d.content.statics.begin(), d.content.statics.end(),
                             [&](const StaticResult& other) { return other.torque == s.torque; });
        }))
      out.push_back(s.torque);
  return out;
}

// Gears are called by their role: two designs may name them differently.
ReportContent by_role(ReportContent c) {
  const auto rename = [](auto& artifact) {
    for (int g = 0; g < kSides; ++g) artifact.mesh.gear[g] = kRole[g];
  };
  for (StaticResult& s : c.statics) rename(s);
  for (ImpactResult& a : c.impacts) rename(a);
  for (ResponseResult& sweep : c.sweeps) rename(sweep);
  return c;
}

bool any_train(const std::vector<Design>& designs) {
  return std::any_of(designs.begin(), designs.end(), [](const Design& d) { return d.train.has_value(); });
}

void require_designs(const std::vector<Design>& designs) {
  if (designs.size() < 2)
    fail(Failure::input, "compare: ", designs.size(), " design given; two are the least");
  for (const Design& d : designs)
    if (d.train ? !d.train->rest : d.content.statics.empty())
      fail(Failure::input, "compare: ", d.name, " has no static.h5",
           d.train ? "; rigid gears have natural modes alone" : "");
  if (any_train(designs)) return;
  if (common_torques(designs).empty())
    fail(
        Failure::input,
        "compare: the designs have no torque in common; give each of the scenes one torque_Nm of the others");
}

std::string differences_table(const std::vector<Design>& designs, const std::vector<Difference>& rows,
                              const std::string& caption, bool of_scene) {
  if (rows.empty()) return html::paragraph("Nothing differs.");
  std::vector<std::string> head{of_scene ? "key" : "quantity", "unit"};
  if (!of_scene) head.insert(head.begin(), any_train(designs) ? "mesh or body" : "torque (N m)");
  for (const Design& d : designs) head.push_back(d.name);
  const auto changed = [&](size_t d) {
    return !of_scene ||
           std::any_of(rows.begin(), rows.end(), [&](const Difference& r) { return !r.change[d].empty(); });
  };
  for (size_t d = 1; d < designs.size(); ++d)
    if (changed(d - 1))
      head.push_back((designs.size() == 2 ? "change" : designs[d].name + " against first") + " (%)");
  html::Rows cells;
  for (const Difference& row : rows) {
    std::vector<std::string> line{row.quantity, row.unit == "1" ? html::kNoValue : row.unit};
    if (!of_scene) line.insert(line.begin(), row.part.empty() ? html::kNoValue : row.part);
    line.insert(line.end(), row.value.begin(), row.value.end());
    for (size_t d = 0; d < row.change.size(); ++d)
      if (changed(d)) line.push_back(row.change[d]);
    cells.push_back(line);
  }
  return html::table(caption, head, cells);
}

std::string compared_picture(const ReportPicture& picture) {
  const bool rest = picture.name.starts_with("compare-rest");
  const char* title = rest ? "At rest" : "In motion";
  const char* words =
      rest
          ? "Static transmission error and secant mesh stiffness over the mesh period, and amplitudes of the harmonics of the error."
          : "RMS and first order of the dynamic transmission error and largest tooth load, of pairs over T / r_b, against speed; falling speed dashed. Where the two lines of a design part it has two motions. Of trains the first mesh of each [[mesh]].";
  return html::figure(picture.name, picture.bytes, title, html::escaped(words));
}

}  // namespace

namespace {

// What a design says: of a pair at the first of its torques.
struct Said {
  Quantities value;
  std::vector<ResponseQuantity> kinds;
};

Said said_by(const Design& d) {
  Said out;
  std::vector<Direction> directions;
  const double torque = d.train ? 0 : d.content.statics.front().torque;
  out.value = d.train ? quantities_of(*d.train->rest) : quantities_of(d.content.statics.front());
  for (const ResponseResult& sweep : d.train ? d.train->sweeps : d.content.sweeps) {
    if (sweep.torque != torque) continue;
    out.value.merge(quantities_of(sweep, d.train ? &d.train->rest->settings : nullptr));
    directions.push_back(sweep.direction);
  }
  out.kinds = response_quantities(directions, d.train ? train_names(d.train->rest->settings) : TrainNames{});
  return out;
}

// One of a mesh, body or [[mesh]] in its parts: "rms_max_up", "sun-planet1"; the words without the part.
struct KindOfPart {
  std::string name, part, words;
};
KindOfPart in_parts(const ResponseQuantity& kind) {
  const size_t dot = kind.name.find('.');
  if (dot == std::string::npos) return {kind.name, "", kind.meaning};
  const std::string part = kind.name.substr(dot + 1), end = ", of " + part;
  return {kind.name.substr(0, dot), part, kind.meaning.substr(0, kind.meaning.size() - end.size())};
}

std::vector<Difference> train_differences(const std::vector<Design>& designs) {
  Rows rows(designs.size());
  std::vector<std::string> meshes;  // of all trains
  for (const Design& d : designs)
    if (d.train)
      for (const std::string& mesh : train_names(d.train->rest->settings).meshes)
        if (std::find(meshes.begin(), meshes.end(), mesh) == meshes.end()) meshes.push_back(mesh);
  for (size_t d = 0; d < designs.size(); ++d) {
    const Said said = said_by(designs[d]);
    for (const ResponseQuantity& kind : said.kinds) {
      const auto found = said.value.find(kind.name);
      if (found == said.value.end()) continue;
      const KindOfPart own = in_parts(kind);
      const ShownUnit unit = shown_units(kind.units);
      // Numbers of jumps are of the whole; all else of a pair is of its one mesh.
      const bool whole = designs[d].train || own.name.starts_with("jump") || own.name.starts_with("unsteady");
      for (const std::string& part : whole ? std::vector{own.part} : meshes)
        rows.put(d, part, own.words, *unit.units ? unit.units : "1", shown(found->second * unit.scale, 4));
    }
  }
  std::vector<Difference> out = rows.differing();
  // A pair has no load sharing; what no train has is left out.
  std::erase_if(out, [&](const Difference& row) {
    for (size_t d = 0; d < designs.size(); ++d)
      if (designs[d].train && row.value[d] != html::kNoValue) return false;
    return true;
  });
  return out;
}

SceneKeys scene_keys_in(const Design& d) {
  if (d.train)
    return scene_keys_of(*d.train->rest, d.train->sweeps.empty() ? nullptr : &d.train->sweeps[0].train);
  const ReportContent& c = d.content;
  return c.sweeps.empty() ? scene_keys_of(c.statics.at(0)) : scene_keys_of(c.sweeps[0]);
}

// Of each gear of a pair or of a train: "gear.teeth, sun".
std::vector<Difference> train_scene_differences(const std::vector<Design>& designs) {
  Rows rows(designs.size());
  for (size_t d = 0; d < designs.size(); ++d) {
    const auto put = [&](const std::string& key, const std::string& gear, const std::string& value) {
      if (!value.empty()) rows.put(d, "", key + (gear.empty() ? "" : ", " + gear), "", value);
    };
    const SceneKeys keys = scene_keys_in(designs[d]);
    for (const SceneKeys::Row& row : keys.rows)
      for (size_t g = 0; g < row.value.size(); ++g)
        put(row.section + "." + row.name, row.value.size() == 1 ? "" : keys.gears[g], row.value[g]);
    if (!designs[d].train) continue;
    const System& layout = designs[d].train->rest->settings.layout;
    for (const System::Drive& drive : layout.drives)
      put("drive.torque_Nm", layout.bodies[static_cast<size_t>(drive.body)].name,
          drive.torque != 0 ? shown(drive.torque, 6) : "");
  }
  return rows.differing();
}

}  // namespace

std::vector<Difference> differences(const std::vector<Design>& designs) {
  require_designs(designs);
  if (any_train(designs)) return train_differences(designs);
  const std::vector<double> torques = common_torques(designs);
  Rows rows(designs.size());
  for (size_t d = 0; d < designs.size(); ++d) {
    const ReportContent content = by_role(designs[d].content);
    for (const GeometryNumber& g : pair_geometry(content.statics.front()))
      rows.put(d, "", g.quantity, g.unit, g.value);
    for (const ReportNumber& n : report_numbers(content))
      if (std::find(torques.begin(), torques.end(), n.torque) != torques.end())
        rows.put(d, shown(n.torque, 6), n.quantity, n.unit, n.value + (n.remark.empty() ? "" : kStar));
  }
  std::vector<Difference> out = rows.differing();
  // Results first: the geometry explains them.
  std::stable_partition(out.begin(), out.end(), [](const Difference& row) { return !row.part.empty(); });
  return out;
}

std::vector<Difference> scene_differences(const std::vector<Design>& designs) {
  if (any_train(designs)) return train_scene_differences(designs);
  Rows rows(designs.size());
  for (size_t d = 0; d < designs.size(); ++d) {
    for (const auto& [section, name, value, meaning] : scene_keys_in(designs[d]).rows) {
      const bool one = value.back().empty() || value.back() == value.front();
      rows.put(d, "", section + "." + name, "", value.front() + (one ? "" : " / " + value.back()));
    }
  }
  // A section that a scene does not have is as good as one of zeros.
  std::vector<Difference> out = rows.differing();
  std::erase_if(out, [](const Difference& row) {
    return std::all_of(row.value.begin(), row.value.end(), [](const std::string& value) {
      double number = 0;
      return value == html::kNoValue || (is_number(value, number) && number == 0);
    });
  });
  return out;
}

std::string compare_tsv(const std::vector<Design>& designs) {
  std::string out = "# designs:",
              head = any_train(designs) ? "part\tquantity\tunit" : "torque [N m]\tquantity\tunit";
  for (const Design& d : designs) {
    out += " " + d.name;
    head += "\t" + d.name;
  }
  for (size_t d = 1; d < designs.size(); ++d)
    head += "\t" + designs[d].name + " against " + designs[0].name + " [%]";
  out += "\n" + head + "\n";
  const auto add = [&](const std::vector<Difference>& rows) {
    for (const Difference& row : rows) {
      out += row.part + "\t" + row.quantity + "\t" + row.unit;
      for (const auto* cells : {&row.value, &row.change})
        for (const std::string& cell : *cells) out += "\t" + cell;
      out += "\n";
    }
  };
  add(differences(designs));
  add(scene_differences(designs));
  return out;
}

std::string compare_html(const std::vector<Design>& designs, const std::vector<ReportPicture>& pictures) {
  require_designs(designs);
  std::string names, list;
  for (const Design& d : designs) {
    names += (names.empty() ? "" : " / ") + d.name;
    list += html::tagged("li", html::escaped(d.train ? d.train->scene : d.content.scene)) + "\n";
  }
  const std::vector<Difference> found = differences(designs);
  const bool starred = std::any_of(found.begin(), found.end(), [](const Difference& row) {
    return std::any_of(row.value.begin(), row.value.end(),
                       [](const std::string& value) { return value.ends_with(kStar); });
  });
  std::string inside =
      "<section id=\"differences\">\n<h2>Differences</h2>\n" +
      differences_table(
          designs, found,
          any_train(designs)
              ? "Results that differ, each design at its own torque; of a pair its one mesh stands beside each mesh. Change against the first design. compare.tsv holds the same."
              : "Results that differ, at the torques that all designs have, then geometry; change against the first design. compare.tsv holds the same.",
          false) +
      (starred
           ? html::paragraph(
                 "* At this speed the motion is larger than the backlash; contact of back flanks is not modelled.")
           : "") +
      differences_table(designs, scene_differences(designs),
                        any_train(designs)
                            ? "Keys of the scenes that differ, by gear."
                            : "Keys of the scenes that differ; of driver / driven gear where these differ.",
                        true) +
      "</section>\n<section id=\"figures\">\n<h2>On common axes</h2>\n";
  for (const ReportPicture& picture : pictures) inside += compared_picture(picture);
  inside += "</section>\n";
  for (const Design& d : designs)
    inside += "<section>\n<h2>" + html::escaped(d.name) + "</h2>\n" +
              (d.train ? system_remarks(*d.train) : remarks_list(d.content)) +
              provenance_table(d.train ? d.train->sources : d.content.sources) + "</section>\n";
  return html::page(names, "<ul>\n" + list + "</ul>\n", inside);
}

}  // namespace whine
