#include "report/figure_list.h"

#include <algorithm>
#include <array>

#include "base/error.h"
#include "gear/layout.h"
#include "report/figure_words.h"
#include "report/one_system.h"
#include "report/response_figures.h"
#include "report/sweep_panels.h"
#include "report/system_picture.h"

namespace whine {
namespace {

constexpr Eigen::Index kOrderCuts = 5;

Figure orders_of_pair(const std::vector<ResponseResult>& sweeps) {
  const auto panels = panels_of(sweeps, {});
  const auto& curve = only_curve(panels, "order cuts");
  Figure figure;
  figure.title = "Order cuts of the dynamic transmission error (DTE), " + torque_words(curve.up->torque);
  figure.notes = {
      operating_words(panels[0], {}) + "; " + panels[0].choices,
      "orders of the mesh frequency; f_n: mean natural frequency over the mesh period, contact frozen under the static load"};
  const Eigen::Index orders = std::min({kOrderCuts, curve.up->harmonics(), curve.down->harmonics()});
  for (const ResponseResult* r : {curve.up, curve.down}) {
    FigureBlock block{
        text("orders ", r->direction), {"mesh_frequency [Hz]"}, {}, "orders", name_of(r->direction)};
    for (Eigen::Index k = 1; k <= orders; ++k) block.columns.push_back(text("order_", k, " [µm]"));
    const std::vector<bool> broken = broken_after(*r, r == curve.up ? curve.down : curve.up);
    for (Eigen::Index i = 0; i < r->mesh_frequency.size(); ++i) {
      std::vector<double> row{r->mesh_frequency[i]};
      for (Eigen::Index k = 0; k < orders; ++k)
        row.push_back(r->dte_harmonic[static_cast<size_t>(i)](k, 0) * kMicro);
      block.rows.push_back(std::move(row));
      if (broken[static_cast<size_t>(i)]) block.rows.emplace_back();
    }
    figure.blocks.push_back(std::move(block));
  }
  figure.shafts = shafts_of_all(sweeps);
  for (Eigen::Index k = 1; k <= orders; ++k) figure.levels.push_back({text("order_", k, " [µm]"), true});
  const double f_n = curve.up->natural_frequency;
  for (const ResponseResult* r : {curve.up, curve.down}) {
    Panel panel{.heading = r == curve.up ? "speed rising" : "speed falling"};
    panel.x = {.label = "Mesh frequency (Hz)", .speed = true};
    panel.y = {.label = "Amplitude of DTE (µm)", .log = true, .decades = 4, .level = true};
    if (r == curve.up)
      panel.top = {.label = "Speed of " + without_markup(r->mesh.gear[0]) + " (rpm)"},
      panel.top_factor = 60.0 / r->gear[0].design.teeth;
    constexpr std::array kDash{1, 1, 3, 4, 5};
    for (int k = 1; k <= orders; ++k)
      panel.curves.push_back({.block = text("orders ", r->direction),
                              .y = k + 1,
                              .colour = k,
                              .label = text("order ", k),
                              .width = k == 1 ? 2.8 : 2.0,
                              .dash = kDash[k - 1]});
    panel.rules = {{'x', f_n, "f_n"}};
    figure.panels.push_back(panel);
  }
  return figure;
}

// Of the meshes of planets of a carrier with one gear that which vibrates most.
std::vector<size_t> most_vibrating_meshes(const std::vector<ResponseResult>& sweeps) {
  const System& s = sweeps.front().layout;
  const auto body = [&](size_t m, size_t side) {
    return s.bodies[static_cast<size_t>(s.meshes[m].side[side].body)];
  };
  const auto alike = [&](size_t m, size_t n) {
    bool planets = false, same = true;
    for (const size_t side : {0, 1}) {
      const System::Body one = body(m, side), other = body(n, side);
      planets = planets || one.on != System::kGround;
      same = same && one.radius == other.radius && one.on == other.on;
    }
    return planets && same;
  };
  const auto vibration = [&](size_t m) {
    double most = 0;
    for (const ResponseResult& sweep : sweeps)
      most = std::max(most, sweep.dte_rms.col(static_cast<Eigen::Index>(m)).maxCoeff());
    return most;
  };
  constexpr double kMore = 1.001;  // what rounding makes of planets that do the same is below it
  std::vector<size_t> meshes;
  for (size_t m = 0; m < s.meshes.size(); ++m) {
    const auto same = std::find_if(meshes.begin(), meshes.end(), [&](size_t n) { return alike(m, n); });
    if (same == meshes.end())
      meshes.push_back(m);
    else if (vibration(m) > kMore * vibration(*same))
      *same = m;
  }
  return meshes;
}

Figure orders_of_train(const std::vector<ResponseResult>& sweeps) {
  if (sweeps.empty() || sweeps[0].mesh_frequency.size() == 0)
    fail(Failure::input, "figure: a sweep of no speeds was given");
  const ResponseResult& a = sweeps.front();
  const System& s = a.layout;
  require_one_system("another sweep", a, sweeps);
  Figure figure;
  figure.title = "Order cuts of the dynamic transmission error (DTE) of a train";
  figure.notes = in_lines(bodies_words(s, a.drive));
  figure.notes.emplace_back(
      "orders of the mesh frequency; solid: rising speed, dashed: falling speed, where it is another");
  constexpr size_t kMostPanels = 4;
  std::vector<size_t> meshes = most_vibrating_meshes(sweeps);
  if (meshes.size() < s.meshes.size())
    figure.notes.emplace_back("of the meshes of planets with one gear that which vibrates most");
  if (meshes.size() > kMostPanels) {
    figure.notes.push_back(text("the first ", kMostPanels, " of ", meshes.size(), " meshes"));
    meshes.resize(kMostPanels);
  }
  Eigen::Index orders = kOrderCuts;
  for (const ResponseResult& sweep : sweeps) orders = std::min(orders, sweep.harmonics());
  for (const size_t mesh : meshes) {
    const std::string name = mesh_name(s, mesh);
    Panel panel{.heading = "mesh of " + without_markup(name)};
    panel.x = {.label = "Mesh frequency (Hz)", .speed = true};
    panel.y = {.label = "Amplitude of DTE (µm)", .log = true, .decades = 4, .level = true};
    for (const ResponseResult& sweep : sweeps) {
      const bool up = sweep.direction == Direction::up;
      FigureBlock block{text("orders ", name, " ", sweep.direction),
                        {"mesh_frequency [Hz]"},
                        {},
                        "orders",
                        text(name, " ", name_of(sweep.direction))};
      for (Eigen::Index k = 1; k <= orders; ++k) {
        block.columns.push_back(text("order_", k, " [µm]"));
        panel.curves.push_back({.block = block.name,
                                .y = static_cast<int>(k) + 1,
                                .colour = static_cast<int>(k),
                                .label = &sweep == &a ? text("order ", k) : "",
                                .width = k == 1 ? 2.8 : 2.0,
                                .dash = up ? 1 : 3});
      }
      for (Eigen::Index i = 0; i < sweep.mesh_frequency.size(); ++i) {
        if (i > 0 && jumps_between(sweep, sweep.mesh_frequency[i - 1], sweep.mesh_frequency[i]))
          block.rows.emplace_back();
        std::vector<double> row{sweep.mesh_frequency[i]};
        for (Eigen::Index k = 0; k < orders; ++k)
          row.push_back(sweep.dte_harmonic[static_cast<size_t>(i)](k, static_cast<Eigen::Index>(mesh)) *
                        kMicro);
        block.rows.push_back(std::move(row));
      }
      figure.blocks.push_back(std::move(block));
    }
    figure.panels.push_back(std::move(panel));
  }
  for (Eigen::Index k = 1; k <= orders; ++k) figure.levels.push_back({text("order_", k, " [µm]"), true});
  add_shafts(s, figure);
  return figure;
}

}  // namespace

Figure order_figure(const std::vector<ResponseResult>& sweeps) {
  return !sweeps.empty() && sweeps[0].of_train() ? orders_of_train(sweeps) : orders_of_pair(sweeps);
}

}  // namespace whine
