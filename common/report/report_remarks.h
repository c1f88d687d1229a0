// What the stages warn of and remark, as HTML: what is said at several torques is said once.
#pragma once
#include <string>
#include <vector>

#include "report/report_content.h"

namespace whine {

std::string remarks_list(const ReportContent& c);

// What its stage says, and what is seen beside the statics and the other direction: contact loss, pressure, motions that do not repeat,
// speeds with two motions, energy that is not accounted for, wide steps.
std::vector<Remark> remarks_on_sweep(const ReportContent& c, const ResponseResult& sweep);

}  // namespace whine
