// gear-variant: one variant of a study, from the bodies to its response quantities, in one go.
//
// Reads   params (stage parameters of the variant: mesh, contact, torque, and of motions damping, inertia, speeds,
//         fidelity, time), body.h5 of all gears of the pair or train
// Writes  variant.h5    transmission error and stiffness at rest, and of each sweep RMS, loads, contact loss, jumps, as numbers
// With --mark-outside-model a variant of what no pair can do is an artifact, too, which says why; whatever else fails is an error.
// Equations: as gear-static, gear-sweep and gear-spectra, whose numbers these are.
// Example: gear-variant --params out/studies/relief/variants/3f/3f0c.toml --body pinion=out/bodies/0123/body.h5
//            --body wheel=out/bodies/0123/body.h5 --output out/studies/relief/variants/3f/3f0c.h5
#include <optional>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/model_range.h"
#include "base/progress.h"
#include "base/tool.h"
#include "gear/body_inertia.h"
#include "io/artifacts.h"
#include "io/compatibility.h"
#include "io/pair_inputs.h"
#include "io/provenance.h"
#include "io/study.h"
#include "results/variant.h"
#include "studies/study_variant.h"

namespace {

// "variant 17 (damping.rayleigh_stiffness_s = 5.5e-06): " of stage parameters; "" if no plan lists it.
std::string name_in(const std::string& plan, const std::string& params) {
  if (plan.empty()) return "";
  const auto [study, variants] = whine::read_plan(plan);
  for (size_t i = 0; i < variants.size(); ++i)
    if (params.ends_with(whine::variant_file(variants[i].name) + ".toml"))
      return whine::variant_name(study, static_cast<long>(i), variants[i].values) + ": ";
  return "";
}

void body(int argc, char** argv) {
  whine::Options options{"Response quantities of one variant of a study, at rest and in motion",
                         "gear-variant"};
  std::string params, output, plan;
  std::vector<std::string> bodies;
  bool marks = false;
  options.add("--params", params, "stage parameters of the variant, as gear-study writes it").required();
  options.add("--body", bodies, "body.h5 of a gear as <gear>=<path>, once for each").required();
  options.add("--output", output, "artifact to write").required();
  options.add("--plan", plan, "plan.toml of the study, so that errors name the variant and its values");
  options.flag("--mark-outside-model", marks,
               "write why the gears cannot do what the variant asks, instead of failing");
  options.footer(
      "Example:\n"
      "  gear-variant --params $(ls out/studies/damping-torque-relief/variants/*/*.toml | head -n 1) --body pinion=out/parker2000/pinion/body.h5 --body wheel=out/parker2000/wheel/body.h5 --output variant.h5");
  options.parse(argc, argv);

  const whine::NamedFiles files("--body", bodies);
  const whine::Provenance provenance = whine::made_by(argc, argv, files.and_inputs({"params=" + params}));
  whine::VariantParameters settings = whine::read_variant_parameters(params);
  std::vector<whine::ReducedBody> gears;
  if (settings.of_train()) {
    gears = whine::read_bodies(files, settings.train);
  } else {
    for (const whine::ReducedBody& gear : whine::read_bodies(files, settings.statics)) gears.push_back(gear);
    if (!settings.directions.empty()) whine::as_drawn(settings.motion, {gears[0].inertia, gears[1].inertia});
  }
  whine::VariantResult result = whine::variant_parameters(gears, settings);
  std::vector<whine::Remark> remarks;
  try {
    std::optional<whine::Progress> progress;
    const auto report = [&](long done, long total, const std::string& note) {
      if (!progress) progress.emplace("gear-variant", total);
      progress->update(done, note);
    };
    const whine::VariantResponse quantities = whine::variant_response(gears, settings, report);
    result.quantity = quantities.quantity;
    remarks = quantities.remarks;
  } catch (const whine::Error& error) {
    // A solver's failure or too little memory says nothing of the pair, and a mark would keep it from being computed again.
    if (!marks || !dynamic_cast<const whine::ModelRangeError*>(&error))
      whine::fail(error.kind(), params, ": ", name_in(plan, params), error.what());
    result.rejection = error.what();
  }
  whine::write(output, result, provenance);
  if (!result.rejection.empty())
    whine::log_line("gear-variant: warning: outside the model's range: ", result.rejection, " -> ", output);
  else
    whine::log_line("gear-variant: ", settings.of_train() ? "" : whine::text(result.torque, " N m, "),
                    result.quantity.size(), " response quantities -> ", output);
  const std::string name = remarks.empty() ? "" : name_in(plan, params);
  for (const whine::Remark& remark : remarks)
    whine::log_line("gear-variant: ", remark.warning ? "warning: " : "", name.empty() ? params + ": " : name,
                    remark.words);
}

}  // namespace

int main(int argc, char** argv) {
  return whine::run_tool(argc, argv, body);
}
