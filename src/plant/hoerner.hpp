// Two-dimensional cross-flow drag of a ship section.
#pragma once

namespace otter_nav::plant {

// Hoerner's curve C_D(B / 2T) for beam and draft, m (Hoerner 1965; digitised by Leite and others,
// Applied Ocean Research 20, 1998, and used so by Fossen 2021, figure 6.9). Linear between the
// points, the last value beyond them.
[[nodiscard]] double hoernerDrag(double beam_m, double draft_m);

}  // namespace otter_nav::plant
