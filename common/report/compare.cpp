#include "report/compare.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "base/error.h"
#include "io/scene_keys.h"
#include "report/figures.h"
#include "report/html.h"
#include "report/report_gears.h"
#include "report/report_page.h"
#include "report/report_remarks.h"
#include "report/report_results.h"
#include "report/report_tables.h"
#include "report/result_groups.h"

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
    row.change.push_back(both && row.unit != "%" && !row.unit.starts_with("dB")
                             ? (change > 0 ? "+" : "") + fixed(change, 1)
                             : "");
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
  for (const SystemStaticResult& s : designs.at(0).content.statics)
    if (std::all_of(designs.begin(), designs.end(), [&](const Design& d) {
          return std::any_of(d.content.statics.begin(), d.content.statics.end(),
                             [&](const auto& other) { return torque_of(other) == torque_of(s); });
        }))
      out.push_back(torque_of(s));
  return out;
}

// Gears are called by their role: two designs may name them differently.
ReportContent by_role(ReportContent c) {
  const auto rename = [](auto& artifact, GearMeshSpec& mesh, System& layout) {
    for (size_t g = 0; g < kSides; ++g)
      artifact.body_names[g] = layout.bodies[g].name = mesh.gear[g] = kRole[g];
  };
  for (SystemStaticResult& s : c.statics) {
    rename(s, s.mesh[0].mesh, s.settings.layout);
    s.take_pair(s.settings.layout);
  }
  for (ImpactResult& a : c.impacts) rename(a, a.mesh, a.layout);
  for (ResponseResult& sweep : c.sweeps) rename(sweep, sweep.mesh, sweep.layout);
  return c;
}

// No property of a design: how many mesh periods were run, what of the energy rounding leaves.
bool is_of_computation(const ReportNumber& n) {
  return n.group == groups::kSweeps;
}

// Of a number of a report.
std::string with_part(const auto& n) {
  return n.part.empty() ? n.quantity : n.quantity + ", " + n.part;
}

bool any_train(const std::vector<Design>& designs) {
  return std::any_of(designs.begin(), designs.end(), [](const Design& d) { return d.content.of_train(); });
}

void require_designs(const std::vector<Design>& designs) {
  if (designs.size() < 2)
    fail(Failure::input, "compare: ", designs.size(), " design given; two are the least");
  for (const Design& d : designs)
    if (d.content.statics.empty())
      fail(Failure::input, "compare: ", d.name, " has no static.h5",
           d.content.of_train() ? "; rigid gears have natural modes alone" : "");
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

// Meshes and bodies of which a quantity is the same in each design in one row: those of planets that are alike.
std::vector<Difference> by_parts(const std::vector<Difference>& rows) {
  std::vector<Difference> out;
  for (const Difference& row : rows) {
    const auto same = std::find_if(out.begin(), out.end(), [&](const Difference& other) {
      return !row.part.empty() && !other.part.empty() && other.quantity == row.quantity &&
             other.unit == row.unit && other.value == row.value;
    });
    if (same == out.end())
      out.push_back(row);
    else
      same->part += ", " + row.part;
  }
  return out;
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

// Numbers of trains, and of pairs beside them, at the first torque of each: of a pair's one mesh beside each mesh of the trains; what no
// train has is left out.
std::vector<Difference> train_differences(const std::vector<Design>& designs) {
  Rows rows(designs.size());
  std::vector<std::string> meshes;  // of all trains
  for (const Design& d : designs)
    for (const std::string& mesh : d.content.statics[0].mesh_names)
      if (d.content.of_train() && std::find(meshes.begin(), meshes.end(), mesh) == meshes.end())
        meshes.push_back(mesh);
  for (size_t d = 0; d < designs.size(); ++d) {
    const ReportContent& c = designs[d].content;
    for (const ReportNumber& n : report_numbers(c)) {
      if (n.torque != torque_of(c.statics[0]) || is_of_computation(n)) continue;
      const bool everywhere = !c.of_train() && n.of == ReportNumber::Of::mesh;
      for (const std::string& part : everywhere ? meshes : std::vector{n.part})
        rows.put(d, part, n.quantity, n.unit, n.value + (n.remark == kBeyond ? kStar : ""));
    }
  }
  std::vector<Difference> out = rows.differing();
  std::erase_if(out, [&](const Difference& row) {
    for (size_t d = 0; d < designs.size(); ++d)
      if (designs[d].content.of_train() && row.value[d] != html::kNoValue) return false;
    return true;
  });
  return out;
}

// Of each gear of a pair or of a train: "gear.teeth, sun".
std::vector<Difference> train_scene_differences(const std::vector<Design>& designs) {
  Rows rows(designs.size());
  for (size_t d = 0; d < designs.size(); ++d) {
    const auto put = [&](const std::string& key, const std::string& gear, const std::string& value) {
      if (!value.empty()) rows.put(d, "", key + (gear.empty() ? "" : ", " + gear), "", value);
    };
    const SceneKeys keys = scene_keys_in(designs[d].content);
    for (const SceneKeys::Row& row : keys.rows)
      for (size_t g = 0; g < row.value.size(); ++g)
        put(row.section + "." + row.name, row.value.size() == 1 ? "" : keys.gears[g], row.value[g]);
    if (!designs[d].content.of_train()) continue;
    const System& layout = designs[d].content.statics[0].settings.layout;
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
    double number = 0;  // words are keys of the scenes
    for (const GeometryNumber& g : geometry_numbers(content))
      if (is_number(g.value, number)) rows.put(d, "", with_part(g), g.unit, g.value);
    for (const ReportNumber& n : report_numbers(content))
      if (std::find(torques.begin(), torques.end(), n.torque) != torques.end() && !is_of_computation(n))
        rows.put(d, shown(n.torque, 6), with_part(n), n.unit, n.value + (n.remark == kBeyond ? kStar : ""));
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
    for (const auto& [section, name, value, meaning] : scene_keys_in(designs[d].content).rows) {
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
    list += html::tagged("li", html::escaped(d.content.scene)) + "\n";
  }
  const std::vector<Difference> found =
      any_train(designs) ? by_parts(differences(designs)) : differences(designs);
  const bool starred = std::any_of(found.begin(), found.end(), [](const Difference& row) {
    return std::any_of(row.value.begin(), row.value.end(),
                       [](const std::string& value) { return value.ends_with(kStar); });
  });
  std::string inside =
      "<section id=\"differences\">\n<h2>Differences</h2>\n" +
      differences_table(
          designs, found,
          any_train(designs)
              ? "Results that differ, each design at its own torque; of a pair its one mesh stands beside each mesh. Meshes and bodies with the same values share a row. Change against the first design. compare.tsv holds the same."
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
    inside += "<section>\n<h2>" + html::escaped(d.name) + "</h2>\n" + remarks_list(d.content) +
              provenance_table(d.content.sources) + "</section>\n";
  return html::page(names, "<ul>\n" + list + "</ul>\n", inside);
}

}  // namespace whine
