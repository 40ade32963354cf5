#!/usr/bin/env bash
# What is shipped with a cell, detection and picks, has nothing under the GPL in it and nothing that training needs; the
# libraries of the door export what meam.h and picks.h declare and nothing else.
# Usage: libraries.sh DETECT IMAGES PICK TRAIN [VTK MODULE OF A CELL...]
status=0
fail() { echo "$1"; status=1; }
detect=$1 images=$2 pick=$3 train=$4
shift 4
# GDAL and Poppler come with OpenCV's imgcodecs.
training='CGAL|gmp|mpfr|OpenMesh|Bullet|LinearMath|libTK|imgcodecs|gdal|poppler|meamTrain|ppfmeam(Training|IOImage)'
for library in "$detect" "$images" "$pick" "$train"; do
  [ -f "$library" ] || { echo "missing: $library"; exit 1; }
  if ldd "$library" | grep 'not found'; then fail "^ $library does not load"; fi
  if ldd "$library" | grep -E 'libvtk'; then fail "^ $library links them"; fi
  exported=$(nm -DC --defined-only "$library" | cut -c20-)
  [ -n "$exported" ] || fail "$library exports nothing"
  if others=$(grep -vE '^(vtable for |typeinfo for |typeinfo name for )?meam::' <<<"$exported"); then
    fail "$others
^ $library exports names that are not meam's"
  fi
  # Of the core's classes none: Pose, TrainedModel and so on are declared in no header that is installed.
  if inner=$(grep -E 'meam::(estimatePoses|trainModel|readModel|readGrasps|PickPlanner|PointGrid|TrainedModel::)' <<<"$exported"); then
    fail "$inner
^ $library exports what is inside"
  fi
done
for library in "$detect" "$pick" "$@"; do
  [ -f "$library" ] || { echo "missing: $library"; exit 1; }
  if ldd "$library" | grep -E "$training"; then fail "^ $library links what only training needs"; fi
  if nm -C "$library" 2>/dev/null | grep -E 'CGAL::|OpenMesh::|__gmp|mpfr_|btRigidBody'; then fail "^ $library contains it"; fi
  if nm -DC "$library" | grep -E 'CGAL|OpenMesh|__gmp|mpfr_|bt[A-Z]'; then fail "^ $library contains or asks for it"; fi
done
if ldd "$detect" | grep -E 'fcl|octomap'; then fail "^ $detect links what only picks need"; fi
for name in 'meam::detect(' 'meam::loadModel(' 'meam::loadMesh(' 'meam::loadScan(' 'meam::Model::save(' 'typeinfo for meam::Error'; do
  nm -DC --defined-only "$detect" | grep -qF " $name" || fail "$detect does not export $name"
done
for name in 'meam::loadImage(' 'meam::loadDepthImage('; do
  nm -DC --defined-only "$images" | grep -qF " $name" || fail "$images does not export $name"
done
for name in 'meam::Picker::plan(' 'meam::detectBin(' 'meam::graspAt(' 'meam::loadGrasps(' 'meam::saveGrasps(' 'meam::loadRobotFrame('; do
  nm -DC --defined-only "$pick" | grep -qF " $name" || fail "$pick does not export $name"
done
for name in 'meam::train(' 'meam::loadCAD(' 'meam::prepareMesh(' 'meam::proposeGrasps('; do
  nm -DC --defined-only "$train" | grep -qF " $name" || fail "$train does not export $name"
done
exit $status
