// What a report is made of, and words and numbers that its parts share: of a pair, which is two bodies with one mesh, or of a train.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "io/provenance.h"
#include "report/speed_words.h"
#include "results/error_budget.h"
#include "results/impact.h"
#include "results/modes.h"
#include "results/response.h"
#include "results/static.h"
#include "results/sweep_errors.h"

namespace whine {

// A figure as gear-plot draws it; its name says what it shows.
struct ReportPicture {
  std::string name;   // file name without extension: "transmission-error"
  std::string bytes;  // of a PNG
  std::string printed =
      {};  // what a publication shows of the same gears, "Figure 7 of P2000 shows"; "": nothing
};

struct ReportSource {
  std::string path, sha256;
  Origin origin;
};

// Artifacts in the order in which the scene lists its torques; what is not there is left out of the page.
struct ReportContent {
  std::string scene;                        // "file: title"
  std::vector<SystemStaticResult> statics;  // none: of rigid gears
  std::optional<ModesResult> modes = {};
  std::vector<ImpactResult> impacts = {};
  std::vector<ResponseResult> sweeps = {};
  std::optional<ErrorBudgetResult> budget = {};
  std::vector<SweepErrorsResult> errors = {};  // of one torque, one of each direction
  std::vector<ReportPicture> pictures = {};
  std::vector<ReportSource> sources = {};
  std::string figure_folder =
      {};  // of the pictures and their numbers, as the page links them: "", "../report/"

  bool of_train() const { return statics.empty() ? modes.has_value() : statics[0].of_train(); }
  // Of a pair at its first torque.
  const StaticResult& pair() const { return statics.at(0).mesh.at(0); }
};

// N m: the same but for round-off and what torque_of() rounds.
bool one_torque(double a, double b);
// N m: on the driver of a pair, on the input of a train.
double torque_of(const MotionSource& motion);

// Bodies and meshes, of a pair, too.
System layout_of(const ReportContent& c);
bool has_planets(const System& system);  // on a carrier

// At the first torque; of the content at a torque; nullptr if there is none.
const SystemStaticResult* rest_of(const ReportContent& c);
const ResponseResult* sweep_of(const ReportContent& c, double torque, Direction direction);
const ImpactResult* impact_of(const ReportContent& c, double torque);

// Throws Error(input) for content without static.h5 and modes.h5, artifacts of different gears, modifications or trains, two of one kind
// at one torque (of sweeps: and of one direction), and motions at torques of which there is no static.h5.
void require_one_scene(const ReportContent& c);

// Whose rotation stands beside mesh frequencies: the driver, of a train the body with the largest torque; of content without statics and
// modes one whose rotation is not known.
TurningMember driver_of(const ReportContent& c);

double static_force(const StaticResult& s);  // N: normal_force()
double rest_force(const SystemStaticResult& rest,
                  size_t mesh);                       // N: the same, of a train the mean force of a mesh
std::string plain_force_name(const StaticResult& s);  // "T / r_b", of helical gears "T / (r_b cos β_b)"
double peak_to_peak(const Eigen::VectorXd& v);
// N: largest load of a pair of a mesh whose tip edge touches, off the line of action.
double tip_edge_load(const StaticResult& mesh);

// N: amplitude of the first order of a force (phase, xy) that repeats after these mesh periods, x and y together.
double first_order_of_force(const MatrixRM& force, int periods = 1);
std::string decibels(double amplitude);  // of the RMS of a harmonic of this amplitude, re 1

// N, over speed: first order of the force of a mesh or on the bearing of a body; empty where it is not known.
Eigen::VectorXd first_order_of(const std::vector<MatrixRM>& harmonic, Eigen::Index column);

std::string way_words(const ResponseResult& s);  // "speed rising"
std::string hertz(double f);                     // whole Hz
// "1819, 2645", "none": Hz, or times a scale what they are in rpm.
std::string jumps_of(const ResponseResult& r, double scale = 1);
std::string listed(const std::vector<std::string>& words);  // "a, b and c"
std::string significant(double value, int digits);  // with all of its digits: 1.400 where shown() has 1.4

// Speeds (rows) at which the RMS of a response has a peak: higher than its surroundings by a fifth, ascending in frequency;
// the ends of the sweep are none.
std::vector<Eigen::Index> resonances(const ResponseResult& response);
std::vector<Eigen::Index> resonances(const Eigen::VectorXd& mesh_frequency, const Eigen::VectorXd& rms);
}  // namespace whine
