// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkMEAMModelReader
 * @brief Reads a trained model from the one file that vtkMEAMModelWriter, or meam::Model::save in C++, wrote.
 *
 * Output port 0: the trained model as vtkMEAMHashing returns it, a vtkPartitionedDataSetCollection.
 */
#ifndef vtkMEAMModelReader_h
#define vtkMEAMModelReader_h

#include "ppfmeamIOModule.h"
#include "vtkMEAMPropertyMacros.h"
#include "vtkPartitionedDataSetCollectionAlgorithm.h"

class PPFMEAMIO_EXPORT vtkMEAMModelReader : public vtkPartitionedDataSetCollectionAlgorithm
{
public:
  static vtkMEAMModelReader* New();
  vtkTypeMacro(vtkMEAMModelReader, vtkPartitionedDataSetCollectionAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /** The file to read. Default: none. */
  vtkMEAMFileMemberMacro(FileName);

  /** 1 when the file starts like a trained model. */
  int CanReadFile(const char* fileName);

protected:
  vtkMEAMModelReader();
  ~vtkMEAMModelReader() override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  char* FileName = nullptr;
};

#endif
