// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// ParaView's color maps of our arrays, in ParaView's own form of settings. `Rank`: red, green, blue, yellow and pink for
/// the ranks 1 to 5, the same, dark, for 6 to 10, gray for the others, the colors of vtkMEAMPoseInstances. `PartId`: twelve types of part, in
/// colors that are those of no rank; then they begin anew. `Residual`, of vtkMEAMPoseDiagnosis:
/// what the scan shows of a part at a pose and beside it, in colors that are neither those of ranks nor those of picks.
/// `Possible` and `Obstruction`, of vtkMEAMPickPlanning: green
/// where a pick is possible, red where it is not. `PoseOutcome`, of vtkMEAMPoseEvaluation: green where a pose is right, yellow where a
/// better one has found the same copy, violet where it is turned too far, red where it is at another place.
inline constexpr const char* RankColors = R"({ "array_lookup_tables": { "Rank": { "PVLookupTable": {
  "IndexedLookup": 1,
  "AutomaticRescaleRangeMode": -1,
  "AnnotationsInitialized": 1,
  "Annotations": [ "1", "1", "2", "2", "3", "3", "4", "4", "5", "5",
                   "6", "6", "7", "7", "8", "8", "9", "9", "10", "10" ],
  "IndexedColors": [ 0.863, 0.118, 0.118,  0.157, 0.667, 0.196,  0.157, 0.353, 0.863,  0.961, 0.804, 0.118,
                     0.941, 0.471, 0.745,  0.490, 0.039, 0.078,  0.039, 0.353, 0.176,  0.059, 0.137, 0.431,
                     0.529, 0.412, 0.000,  0.510, 0.137, 0.412 ],
  "NanColor": [ 0.588, 0.588, 0.588 ]
} }, "PartId": { "PVLookupTable": {
  "IndexedLookup": 1,
  "AutomaticRescaleRangeMode": -1,
  "AnnotationsInitialized": 1,
  "Annotations": [ "0", "part 1", "1", "part 2" ],
  "IndexedColors": [ 0.302, 0.686, 0.780,  0.902, 0.494, 0.133,  0.549, 0.337, 0.647,  0.604, 0.757, 0.239,
                     0.655, 0.424, 0.286,  0.000, 1.000, 0.800,  1.000, 0.000, 0.902,  0.902, 0.902, 0.702,
                     0.302, 0.000, 1.000,  0.000, 1.000, 0.000,  1.000, 0.800, 1.000,  0.902, 0.000, 0.400 ],
  "NanColor": [ 0.588, 0.588, 0.588 ]
} }, "Residual": { "PVLookupTable": {
  "IndexedLookup": 1,
  "AutomaticRescaleRangeMode": -1,
  "AnnotationsInitialized": 1,
  "Annotations": [ "0", "explained", "5", "missing", "6", "unexplained", "4", "seen past", "1", "turned",
                   "2", "hidden", "3", "not measured" ],
  "IndexedColors": [ 0.0, 0.85, 0.85,  0.05, 0.05, 0.05,  0.7, 1.0, 0.1,  1.0, 0.0, 0.85,  0.95, 0.85, 0.65,
                     0.55, 0.36, 0.2,  0.75, 0.7, 1.0 ]
} }, "Possible": { "PVLookupTable": {
  "IndexedLookup": 1,
  "AutomaticRescaleRangeMode": -1,
  "AnnotationsInitialized": 1,
  "Annotations": [ "1", "possible", "0", "not possible" ],
  "IndexedColors": [ 0.157, 0.667, 0.196,  0.863, 0.118, 0.118 ]
} }, "Obstruction": { "PVLookupTable": {
  "IndexedLookup": 1,
  "AutomaticRescaleRangeMode": -1,
  "AnnotationsInitialized": 1,
  "Annotations": [ "0", "possible", "1", "uncertain", "2", "covered", "3", "wrong kind", "4", "too wide", "5", "tilted",
                   "6", "part itself", "7", "bin", "8", "instance", "9", "measured" ],
  "IndexedColors": [ 0.157, 0.667, 0.196,  0.588, 0.588, 0.588,  0.588, 0.235, 0.745,  0.3, 0.3, 0.3,  0.4, 0.4, 0.4,
                     0.961, 0.804, 0.118,  0.941, 0.471, 0.745,  0.157, 0.353, 0.863,  0.863, 0.118, 0.118,
                     0.95, 0.5, 0.1 ]
} }, "PoseOutcome": { "PVLookupTable": {
  "IndexedLookup": 1,
  "AutomaticRescaleRangeMode": -1,
  "AnnotationsInitialized": 1,
  "Annotations": [ "0", "right", "1", "duplicate", "2", "wrong turn", "3", "wrong place" ],
  "IndexedColors": [ 0.157, 0.667, 0.196,  0.961, 0.804, 0.118,  0.588, 0.235, 0.745,  0.863, 0.118, 0.118 ]
} } } })";
