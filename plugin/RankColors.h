// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// ParaView's color map of the array `Rank`, in ParaView's own form of settings: red, green, blue, yellow and pink for
/// the ranks 1 to 5, gray for the others. The colors are those of vtkMEAMPoseInstances.
inline constexpr const char* RankColors = R"({ "array_lookup_tables": { "Rank": { "PVLookupTable": {
  "IndexedLookup": 1,
  "AutomaticRescaleRangeMode": -1,
  "AnnotationsInitialized": 1,
  "Annotations": [ "1", "1", "2", "2", "3", "3", "4", "4", "5", "5" ],
  "IndexedColors": [ 0.863, 0.118, 0.118,  0.157, 0.667, 0.196,  0.157, 0.353, 0.863,  0.961, 0.804, 0.118,
                     0.941, 0.471, 0.745 ],
  "NanColor": [ 0.588, 0.588, 0.588 ]
} } } })";
