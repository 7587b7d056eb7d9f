// The whole table of shading/reflection_probes.h, fitted node by node; the result is kept as shading/reflection_probes_table.cpp.
#pragma once

#include "tests/reference/shading/probe_fit.h"

#include <string>
#include <vector>

namespace rawtexel::reference {

/// All nodes of the table, each begun from its neighbours, so that probes change steadily from node to node. Takes a minute or two.
std::vector<FittedProbes> fit_all_probes();

/// n.v and roughness of node (view, roughness).
double node_view(int view);
double node_roughness(int roughness);

/// The text of shading/reflection_probes_table.cpp.
std::string probe_table_source(const std::vector<FittedProbes>& nodes);

}  // namespace rawtexel::reference
