// The void-and-cluster method written out: every repulsion between two entries in a matrix, every choice by looking at all entries.
#pragma once

#include "texunit/noise/void_and_cluster.h"

namespace rawtexel::texunit::reference {

/// What make_mask and make_companion return, for `first` empty and not. Memory and time grow with the square of the size.
std::vector<uint32_t> void_and_cluster(const noise::VoidAndCluster& method, const std::vector<uint32_t>& first = {});

}  // namespace rawtexel::texunit::reference
