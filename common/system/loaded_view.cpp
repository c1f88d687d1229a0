#include "system/loaded_view.h"

#include <algorithm>
#include <vector>

#include "base/error.h"

namespace whine {
namespace {

using Eigen::Index;

const MatrixRM& cell_field(const LoadedResult& a, const char* name) {
  for (const auto& field : a.vtk_cell_data)
    if (field.name == name) return field.values;
  fail(Failure::numerical, "the view of the loaded gears has no cell field '", name, "'");
}

MatrixRM rows_of(const MatrixRM& from, const std::vector<int>& kept) {
  MatrixRM out(static_cast<Index>(kept.size()), from.cols());
  for (size_t i = 0; i < kept.size(); ++i) out.row(static_cast<Index>(i)) = from.row(kept[i]);
  return out;
}

}  // namespace

void thin_view(LoadedResult& a, int beside) {
  constexpr Index kCorners = 4;
  if (a.vtk_cell.cols() <= kCorners) return;
  const MatrixRM &gear = cell_field(a, "gear"), &tooth = cell_field(a, "tooth");
  const int teeth[2] = {a.gear[0].design.teeth, a.gear[1].design.teeth};
  for (Index e = 0; e < a.vtk_cell.rows(); ++e) {
    const int g = static_cast<int>(gear(e, 0)) - 1, here = static_cast<int>(tooth(e, 0));
    bool near = false;
    for (Index j = 0; j < a.tooth.rows(); ++j) {
      const int apart = ((here - a.tooth(j, g)) % teeth[g] + teeth[g]) % teeth[g];
      near = near || std::min(apart, teeth[g] - apart) <= beside;
    }
    if (!near) a.vtk_cell.row(e).tail(a.vtk_cell.cols() - kCorners).setConstant(-1);
  }

  std::vector<int> place(static_cast<size_t>(a.vtk_point.rows()), -1), kept;
  for (const MatrixRMi* kind : {&a.vtk_cell, &a.vtk_line})
    for (Index i = 0; i < kind->size(); ++i)
      if (const int point = kind->data()[i]; point >= 0) place[static_cast<size_t>(point)] = 0;
  for (size_t i = 0; i < place.size(); ++i)
    if (place[i] == 0) {
      place[i] = static_cast<int>(kept.size());
      kept.push_back(static_cast<int>(i));
    }
  for (MatrixRMi* kind : {&a.vtk_cell, &a.vtk_line})
    for (Index i = 0; i < kind->size(); ++i)
      if (int& point = kind->data()[i]; point >= 0) point = place[static_cast<size_t>(point)];
  a.vtk_point = rows_of(a.vtk_point, kept);
  for (auto& field : a.vtk_point_data) field.values = rows_of(field.values, kept);
}

}  // namespace whine
