// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace meam
{
// Shares of the part's diameter that several steps mean: they follow how finely parts of any size are sampled, trained
// and measured in a usual bin.
inline constexpr double FitDistance = 0.03;       ///< a model point this near to the scene fits
inline constexpr double ExplainedDistance = 0.01; ///< a scene edge this near to an edge of the part is explained by it
inline constexpr double UnexplainedDistance = 0.02; ///< a scene point this far from the part is not explained by it
inline constexpr float FacingSurface =
  0.8f; ///< cosine of the part's normal and the measured one, from which on a surface fits

/// Of the thickness of a flat part: what is measured so far off its face is the floor, or the face of another copy.
inline constexpr float OtherFace = 0.5f;

// Two poses that no step has refined yet are one and the same below both.
inline constexpr double SamePoseDistance =
  0.1;                                        ///< of the diameter, between the part's middles: no two copies are nearer
inline constexpr double SamePoseAngle = 15.0; ///< degrees: two steps of the voted rotation

// Where a few copies are asked for, a search ends when so many more are sure: what all poses together say takes some
// away.
inline constexpr double SureLogOdds = 3.0; ///< that a copy is there
inline constexpr int SpareCopies = 2;
}
