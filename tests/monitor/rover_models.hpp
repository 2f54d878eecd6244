// Two rover models built by hand, so that the traces can be judged without CSPM: the paper's figure
// (label fig:roverCSP, `corpus/rover/rover.csp`) and the model of Varanus's journal example
// (`rover_model.csp`).
#pragma once

#include "perentie/lts/lts.hpp"

namespace perentie::monitor {

/// mission_start -> ROVER({0..5}, Green) of the paper's figure.
lts::Lts paper_rover();

/// ROVER({}, Green) of Varanus's inspection-rover-ras example.
lts::Lts journal_rover();

}  // namespace perentie::monitor
