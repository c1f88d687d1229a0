// readings.h5: what each reading of P2000 gives.
#pragma once
#include <string>
#include <vector>

#include "io/readings.h"

namespace whine {

// One reading with all that it fixes, and how it stands to each claim.
struct Reading {
  OpenChoices choices;
  double rack_tip_radius = 0;                        // modules
  double bore_radius = 0, total_inertia = 0;         // m, kg m2: fitted
  double rayleigh_mass = 0, rayleigh_stiffness = 0;  // s-1, s: fitted
  double level_ratio = 0;             // 1: stiffness with two pairs over that with one, 100 N m
  double first_harmonic = 0;          // 1: first harmonic of k over its mean, 150 N m
  double jump_up = 0, jump_down = 0;  // Hz, 150 N m, near f_n; 0: none
  std::vector<int> verdict;           // (claim) as Verdict of the scorecard
  std::vector<double> value;          // (claim) in its unit; 0 where there is no such state
  std::vector<int> exists;            // (claim) 0: the state that the claim is about does not exist
};

// readings.h5
struct ReadingsResult {
  std::string title;
  ContactModel contact = ContactModel::line;  // of the sweeps
  std::vector<std::string> claim;             // names
  std::vector<Reading> readings;
  int outside = 0;  // readings that the model of the pair cannot compute
};

}  // namespace whine
