// Readings of P2000: gears, damping and sampling for what the paper leaves open, held against its claims.
//
// Tied to numbers that P2000 prints, so fitted and not predicted:
//   bore         mean secant mesh stiffness 462.1 N/µm at 100 N m
//   inertia      natural frequency of Table 1 at 100 N m with one pair (2480 Hz), two pairs (3040 Hz) or on the mean
//                (2900 Hz), or I = 2 r_b^2 x 1.4 kg
//   mu, eta      damping ratio 0.07 at 150 N m in a contact state, a share of it from mu (Eq. 21)
// What these do to the claims is computed with contact lines, frozen eigenvalues and coarse steps of the speed; the best
// readings are confirmed as scenes by the stages themselves.
#pragma once
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "io/artifacts.h"
#include "io/readings.h"
#include "io/readings_result.h"
#include "io/scene.h"
#include "paper/scorecard.h"
#include "results/reduced_body.h"
#include "results/static.h"

namespace whine {

inline constexpr double kPaperMeanStiffness = 462.1e6;  // N m-1
inline constexpr double kPaperDampingRatio = 0.07;      // 1
inline constexpr double kPaperMass = 1.4;               // kg

// How closely a reading is looked at: the search's settings, or those that confirm its best.
struct ReadingLevel {
  double from = 800, to = 3400, step = 50;    // Hz, speeds of the sweeps
  ContactModel contact = ContactModel::line;  // of the sweeps
};
inline const ReadingLevel kConfirming{800, 3400, 20, ContactModel::strips};

// Bodies by bore for one tooth form and plane state, reduced at a coarse setting and kept.
class BoreFamily {
 public:
  BoreFamily(const Scene& scene, const OpenChoices& choices);
  const GearDesign& design() const { return gear_.design; }
  // The body with the bore nearest to `bore` among multiples of 1 mm.
  const ReducedBody& body(double bore);
  // m: the bore, a multiple of 1 mm, whose mean mesh stiffness under this corner rule is nearest to 462.1 N/µm at
  // 100 N m. Throws Error(input) if none between 20 mm and the rim does so to 2 %.
  double tied_bore(const CornerRule& corner);

 private:
  double mean_stiffness(int steps, const CornerRule& corner);
  Scene scene_;
  SceneGear gear_;
  std::map<int, ReducedBody> bodies_;
};

// A pair of gears with all that does not depend on inertia and damping: statics, lumped models.
class PaperPair {
 public:
  // bore: m; that of BoreFamily::tied_bore, or of a reading that is to be confirmed. claims: what readings are judged by, and
  // Table 1, which the inertia is fitted to.
  PaperPair(BoreFamily& family, double bore, const Scene& scene, const OpenChoices& choices,
            const ReadingLevel& level, std::vector<Claim> claims);
  // Fits inertia and damping and judges. Throws Error as the stages do where the model of the pair does not hold.
  Reading evaluate(const OpenChoices& choices);
  // Judges with the inertia and damping that the reading has.
  Reading judge(Reading reading) const;
  double bore() const { return bore_; }

 private:
  double tied_inertia(const std::string& from);
  double tied_rayleigh_stiffness(const OpenChoices& choices, double inertia, double rayleigh_mass) const;
  SweepParameters impact_parameters(const OpenChoices& choices, double inertia) const;
  void add_lumped(const Scene& scene);

  std::vector<Claim> claims_;
  const ReducedBody& body_;
  double bore_;
  ReadingLevel level_;
  TimeDiscretisation time_;
  SceneResults pair_;                      // what all readings of the pair share
  std::map<int, StaticResult> rest_;       // by torque, with one contact line per tooth pair
  std::map<std::string, double> inertia_;  // kg m2, by what it is fitted to
};

// Claims that a reading is fitted to, by their names: they agree by construction.
std::set<std::string> fitted_claims(const OpenChoices& choices);

}  // namespace whine
