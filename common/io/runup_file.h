// runup.h5: a motion while the speed changes, written as it comes.
#pragma once
#include <memory>
#include <string>

#include "io/provenance.h"
#include "studies/runup.h"

namespace whine {

// Writes blocks of samples into a file beside `path` that is published with the last of them; removed if they do not come.
class RunupFile : public RunupSink {
 public:
  RunupFile(std::string path, Provenance provenance);
  ~RunupFile() override;
  void begin(const RunupResult& head, Eigen::Index samples, Eigen::Index periods) override;
  void take(const RunupSamples& samples) override;
  void take(const RunupPeriods& periods) override;
  void end(const RunupResult& tail) override;

 private:
  struct Open;
  std::string path_;
  Provenance provenance_;
  std::unique_ptr<Open> open_;
};

}  // namespace whine
