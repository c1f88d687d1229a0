#include "report/figure_list.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "base/error.h"
#include "io/scene_keys.h"

namespace whine {
namespace {

using Eigen::Index;

struct VariantRow {
  std::string label, key;
  const JumpMapResult* map;
};

double load(const JumpMapResult& a, Index c) {
  return a.sustained_tooth_load.row(c).maxCoeff();
}

// One for each variant; those of the key that moves the end of the upper branch most in the last case come first.
std::vector<VariantRow> variant_rows(const JumpMapResult& base, const std::vector<JumpMapResult>& variants) {
  const Index cases = base.damping_ratio.size(), shown = cases - 1;
  std::vector<VariantRow> rows;
  for (const JumpMapResult& v : variants) {
    if (v.torque != base.torque || v.damping_ratio.size() != cases)
      fail(Failure::input, "a variant at ", v.torque, " N m with ", v.damping_ratio.size(),
           " cases stands beside a base at ", base.torque, " N m with ", cases, "; make all of them again");
    const std::string label = changed_keys(base, v);
    if (label.empty())
      fail(Failure::input, "a variant has the same keys as the base; its change changes nothing");
    rows.push_back({label, label.substr(0, label.find(' ')), &v});
  }
  // What moves the end of the upper branch most stands on top; a branch that is gone moves it most of all.
  const auto effect = [&](const JumpMapResult& v) {
    if (v.two_branches[shown] != base.two_branches[shown])
      return 1e9 + std::abs(v.sustained_tooth_load.row(shown).maxCoeff() -
                            base.sustained_tooth_load.row(shown).maxCoeff());
    return std::abs(v.branches_from[shown] - base.branches_from[shown]) +
           1e-6 * std::abs(v.mean_stiffness - base.mean_stiffness);
  };
  std::map<std::string, double> of_key;
  for (const VariantRow& row : rows) of_key[row.key] = std::max(of_key[row.key], effect(*row.map));
  std::stable_sort(rows.begin(), rows.end(), [&](const VariantRow& a, const VariantRow& b) {
    return of_key[a.key] != of_key[b.key] ? of_key[a.key] > of_key[b.key] : a.key < b.key;
  });
  return rows;
}

// What each variant changes in case c, and its own numbers.
FigureBlock changes_block(const JumpMapResult& base, const std::vector<VariantRow>& rows, Index c) {
  const bool shown = c == base.damping_ratio.size() - 1;
  FigureBlock block{
      shown ? "changes" : text("changes at eta ", rounded(base.rayleigh_stiffness[c] * 1e6, 3), "e-6 s"),
      {"variant", "mean_stiffness [%]", "one_pair_frequency [Hz]", "two_pair_frequency [Hz]",
       "branches_from [Hz]", "branches_to [Hz]", "sustained_tooth_load [%]", "two_branches [1]",
       "open_below [1]", "damping_ratio [%]", "rayleigh_stiffness [1e-6 s]", "branches_from, itself [Hz]",
       "branches_to, itself [Hz]", "sustained_tooth_load, itself [kN]", "sampled peak up, itself [kN]",
       "sampled peak down, itself [kN]"},
      {},
      "",
      "",
      true};
  for (size_t i = 0; i < rows.size(); ++i) {
    const JumpMapResult& v = *rows[i].map;
    const bool both = v.two_branches[c] && base.two_branches[c];
    block.rows.push_back(
        {static_cast<double>(i), (v.mean_stiffness / base.mean_stiffness - 1) * 100,
         v.one_pair_frequency - base.one_pair_frequency, v.two_pair_frequency - base.two_pair_frequency,
         both ? v.branches_from[c] - base.branches_from[c] : 0,
         both ? v.branches_to[c] - base.branches_to[c] : 0, (load(v, c) / load(base, c) - 1) * 100,
         static_cast<double>(v.two_branches[c]), static_cast<double>(v.open_below[c]),
         v.damping_ratio[c] * 100, v.rayleigh_stiffness[c] * 1e6, v.branches_from[c], v.branches_to[c],
         load(v, c) * 1e-3, v.peak_tooth_load(c, 0) * 1e-3, v.peak_tooth_load(c, 1) * 1e-3});
  }
  return block;
}

std::string branch_words(const JumpMapResult& a, Index c) {
  return a.two_branches[c]
             ? text("two branches from ", rounded(a.branches_from[c], 0),
                    a.open_below[c] ? " Hz or less to " : " to ", rounded(a.branches_to[c], 0), " Hz")
             : std::string("one branch");
}

}  // namespace

Figure sensitivity_figure(const JumpMapResult& base, const std::vector<JumpMapResult>& variants) {
  if (variants.empty())
    fail(Failure::input, "sensitivity needs the map of one variant at least beside the base's");
  const Index cases = base.damping_ratio.size(), shown = cases - 1;
  const std::vector<VariantRow> rows = variant_rows(base, variants);
  Figure figure;
  figure.title = text("What inputs are worth at ", base.torque, " N m, ",
                      rounded(base.damping_ratio[shown] * 100, 2), " % damping with two pairs in contact");
  figure.notes.push_back(text(
      "base: mean stiffness ", rounded(base.mean_stiffness * 1e-6, 1), " N/µm, natural frequencies ",
      rounded(base.one_pair_frequency, 0), " Hz (one pair) and ", rounded(base.two_pair_frequency, 0),
      " Hz (two), ", branch_words(base, shown), ", tooth load up to ", rounded(load(base, shown) * 1e-3, 2),
      " kN; eta ", rounded(base.rayleigh_stiffness[shown] * 1e6, 2), "e-6 s"));
  figure.notes.push_back(text(
      "each variant has an eta of its own for the same ratio; ×: one branch; △: goes on below the least speed; in the table also at one eta; contact = ",
      base.fidelity.contact, ", steps of ",
      rounded(base.mesh_frequency.size() > 1 ? base.mesh_frequency[1] - base.mesh_frequency[0] : 0, 1),
      " Hz"));
  std::vector<FigureBlock> named;  // the same rows under the names of the variants
  for (Index c = cases; c-- > 0;) {
    FigureBlock block = changes_block(base, rows, c);
    const std::string at = text(" at eta ", rounded(base.rayleigh_stiffness[c] * 1e6, 3), "e-6 s");
    for (size_t i = 0; i < rows.size(); ++i)
      named.push_back(
          {text("variant ", i, at), block.columns, {block.rows[i]}, "variants", rows[i].label + at});
    figure.blocks.push_back(block);
  }
  figure.blocks.insert(figure.blocks.end(), named.begin(), named.end());
  figure.captions = figure.notes;
  std::vector<std::string> names;
  for (size_t i = 0; i < rows.size(); ++i) {
    figure.notes.push_back(text("variant ", i, ": ", rows[i].label));
    // The keys of a variant that two gears have in turn, a line each.
    std::string label = without_markup(rows[i].label);
    if (const size_t both = label.find("; "); both != std::string::npos) label.replace(both, 2, ";\n");
    names.push_back(label);
  }
  constexpr std::array kChanged{"mean stiffness (%)", "f, one pair (Hz)", "f, two pairs (Hz)",
                                "branches from (Hz)", "branches to (Hz)", "tooth load (%)"};
  FigureBlock gone{"one branch", {"change", "variant"}, {}, "", "", true},
      open{"goes on below", {"change", "variant"}, {}, "", "", true};
  for (const auto& row : figure.blocks[0].rows) {
    if (row[7] == 0)
      gone.rows.push_back({0, row[0] + 1});
    else if (row[8] > 0)
      open.rows.push_back({row[4], row[0] + 1});
  }
  for (size_t k = 0; k < kChanged.size(); ++k) {
    double reach = 0;
    for (const auto& row : figure.blocks[0].rows) reach = std::max(reach, std::abs(row[k + 1]));
    if (reach == 0) reach = 1;
    Panel panel{.x = {.label = kChanged[k], .from = -1.12 * reach, .to = 1.12 * reach},
                .y = {.names = k ? std::vector<std::string>(names.size()) : names},
                .curves = {{.block = "changes",
                            .y = static_cast<int>(k) + 2,
                            .style = PanelStyle::rows,
                            .width = 0.72,
                            .shift = 1}},
                .rules = {{'x', 0, "", kDark, 1}},
                .key = PanelKey::none,
                .height = std::max(300, 60 * static_cast<int>(names.size()))};
    if (k == 3 || k == 4)
      panel.curves.push_back({.block = gone.name,
                              .style = PanelStyle::points,
                              .colour = kVermilion,
                              .width = 2.4,
                              .mark = 2,
                              .size = 1.6});
    if (k == 3)
      panel.curves.push_back(
          {.block = open.name, .style = PanelStyle::points, .colour = kBlack, .mark = 8, .size = 1.8});
    figure.panels.push_back(panel);
  }
  figure.columns = kChanged.size();
  figure.blocks.push_back(gone);
  figure.blocks.push_back(open);
  return figure;
}

}  // namespace whine
