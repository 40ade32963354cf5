// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkMEAMEstimationAlgorithm
 * @brief Base of the filters that take a part and a scan, and detect the part with the parameters of a preset.
 *
 * Trains the model of the part (paper, Section 4) unless it gets one, and extracts the scene's edges from its image
 * unless it gets them. The trained model is kept until the CAD or a setting that it depends on changes, and filters
 * that have the same CAD and settings share it.
 *
 * Input port 0: the part, a vtkPolyData with the CAD's faces, or the trained model that vtkMEAMHashing
 * returns, a vtkPartitionedDataSetCollection. Repeatable, for several types of part in one scan.
 * Input port 1: the scene in mm, a vtkStructuredGrid of W x H x 1 points in the sensor's frame, or a
 * vtkPolyData with the points of the measured surface, which are brought onto a grid (meam::prepareScan).
 * Input port 2 (optional): the scene's edge points, a vtkPolyData. Without it they are found in the scan: in its image,
 * which is port 3 or the point array `Intensity` (1) or `RGB` (3), and by its depth.
 * Input port 3 (optional): the image, a vtkImageData with 1, 3 or 4 components; of W x H, or of any size when the
 * camera that took it is known as vtkMEAMSceneEdgeExtraction has it.
 */
#ifndef vtkMEAMEstimationAlgorithm_h
#define vtkMEAMEstimationAlgorithm_h

#include "ppfmeamDetectionModule.h"
#include "vtkMEAMSensorAlgorithm.h"

#include <memory>

namespace meam
{
struct DetectSettings;
}

class PPFMEAMDETECTION_EXPORT vtkMEAMEstimationAlgorithm : public vtkMEAMSensorAlgorithm
{
public:
  vtkTypeMacro(vtkMEAMEstimationAlgorithm, vtkMEAMSensorAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /** The scene, its edge points, and its image. */
  void SetSceneConnection(vtkAlgorithmOutput* scene) { this->SetInputConnection(1, scene); }
  void SetBoundaryConnection(vtkAlgorithmOutput* boundary) { this->SetInputConnection(2, boundary); }
  void SetImageConnection(vtkAlgorithmOutput* image) { this->SetInputConnection(3, image); }
  ///@}

  enum Presets
  {
    Paper = 0,
    Recommended = 1,
    WithoutMEAM = 2,
    OriginalPPF = 3,
    B2B = 4
  };

  ///@{
  /**
   * The method, by the parameters of all steps: PPF-MEAM as in the paper, Section 6 (0), or as it measures better (1);
   * and what the paper compares itself with: B2B-TL with one model of the whole part (2, Section 6.2.4), pairs of
   * surface points with normals (3, Drost et al. 2010), and pairs of points on line segments (4, Choi et al. 2012). The
   * last two rank poses by their votes. Default: Recommended.
   */
  vtkMEAMDeclareSettingMacro(Preset, int);
  void SetPresetToPaper() { this->SetPreset(Paper); }
  void SetPresetToRecommended() { this->SetPreset(Recommended); }
  void SetPresetToWithoutMEAM() { this->SetPreset(WithoutMEAM); }
  void SetPresetToOriginalPPF() { this->SetPreset(OriginalPPF); }
  void SetPresetToB2B() { this->SetPreset(B2B); }
  ///@}

  enum FeatureChoices
  {
    Edges = 0,
    Surface = 1,
    Both = 2
  };

  ///@{
  /**
   * By which points the part is trained, and poses are looked for. Edges (0): edge points with tangents, which carry
   * flat, thin and ribbed parts. Surface (1): surface points with normals, which carry smooth, round and thick ones.
   * Both (2). Of presets other than Recommended this has no effect: the method says it. Default: Both.
   */
  vtkMEAMDeclareSettingMacro(Features, int);
  void SetFeaturesToEdges() { this->SetFeatures(Edges); }
  void SetFeaturesToSurface() { this->SetFeatures(Surface); }
  void SetFeaturesToBoth() { this->SetFeatures(Both); }
  ///@}

  /** Poses wanted, the best ones; 0 for all. Default: 5. */
  vtkMEAMDeclareSettingMacro(MaximumNumberOfPoses, int);

  /**
   * Of what comes out, poses are dropped where a copy is less likely to be there, however it is turned, in [0, 1].
   * Default: 0.
   */
  vtkMEAMDeclareSettingMacro(MinimumProbability, double);

  /**
   * The minimum probability is that of the pose, its rotation included: poses of a nearly round part whose
   * rotation is unsure are dropped, too. Default: off.
   */
  vtkMEAMDeclareFlagMacro(RotationCounts);

  /**
   * Share of the scene's edge points, and of its surface points, that are reference points, in [0, 1] (P_ref, Section
   * 5.1); 0: the preset's, as vtkMEAMPoseDetection has them. More finds more of the hidden copies and takes longer.
   * Default: 0.
   */
  vtkMEAMDeclareSettingMacro(ReferenceShare, double);

  /** Seconds from the scan to the poses, without training, after which the best come out that are found until then; 0:
   *  no limit. What is found by then depends on the machine. vtkMEAMPoseDiagnosis takes no heed of it. Default: 0. */
  vtkMEAMDeclareSettingMacro(TimeLimit, double);

  /** Of all random choices: the same seed gives the same result. Default: 1. */
  vtkMEAMDeclareSettingMacro(Seed, int);

  ///@{
  /** Which edges of the scene to look for, as in vtkMEAMSceneEdgeExtraction. Default: all; the preset Paper takes those
   * of the image alone. */
  vtkMEAMDeclareFlagMacro(ImageEdges);
  vtkMEAMDeclareFlagMacro(DepthEdges);
  vtkMEAMDeclareFlagMacro(Creases);
  ///@}

  /**
   * Where parts are looked for, mm: from and to along the x, y and z axes of the scan; parts whose middle lies
   * elsewhere are not looked for, and what is far from it is not looked at. All 0: everywhere. The scan may have a mask
   * besides, the point array `Region`, 0 for points that are left out. Default: 0.
   */
  vtkMEAMVectorMemberMacro(Region, double, 6);

  /** The calibration of a camera beside the sensor that took the image. Default: none. */
  vtkMEAMFileMemberMacro(CameraFile);

  /** Factor on the CAD's coordinates, to bring them to mm. No meaning for a trained model. Default: 1. */
  vtkMEAMMemberMacro(CADScale, double);

  /** mm, added to the CAD's coordinates after the scale. No meaning for a trained model. Default: 0, 0, 0. */
  vtkMEAMVectorMemberMacro(CADOffset, double, 3);

protected:
  vtkMEAMEstimationAlgorithm();
  ~vtkMEAMEstimationAlgorithm() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestUpdateExtent(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestInformation(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

  /// What detection works with (vtkMEAMEstimationWork.h).
  struct Work;
  /// Throws the core's Error for inputs that cannot be worked with. The progress goes to `Work::Prepared`.
  Work Prepare(vtkInformationVector** inputVector);

private:
  class Training;
  std::unique_ptr<Training> Trained;

  std::unique_ptr<meam::DetectSettings> Settings;
  char* CameraFile = nullptr;
  double CADScale = 1.0;
  double CADOffset[3] = { 0.0, 0.0, 0.0 };
  double Region[6] = { 0.0, 0.0, 0.0, 0.0, 0.0, 0.0 };
};

#endif
