# SPDX-License-Identifier: Apache-2.0
# Read by ctest after the tests are known: those that take more than about four seconds start first,
# so that no processor is idle while the last of them ends.
set_tests_properties(
  FinalGather.LeavesNoSplotchesAndComesNearerToThePathsWithRaysAndDensity
  IntegratingCube.HasItsMeanIndirectIlluminanceByEveryMethod
  Estimators.LightSamplesLobesAndBothShowTheSamePicture
  LightLayers.WithoutItsLightsTheBeautyIsLessByTheLayer
  LightLayers.SumToTheBeautyInEveryMethod
  PortalRoom.HasTheLightOfAnHdrPictureOnEveryWall
  PortalRoom.HasTheLightOfThePhysicalSkyOnEveryWall
  OutputsProgram.EveryFormatThatIsNamedIsWritten
  Writers.ToneMappedPicturesSurviveEverySizeLimit
  RenderFaults.TheOldPictureIsThereUntilTheNewOneIsFinished
  RenderFaults.InterruptionInTheFirstPassKeepsTheOldPicture
  PhotonEmission.MeasuredLightsSendByTheirProfile
  PhotonTrace.PhotonsAndPathsGiveTheSameIndirectLight
  EnvBlur.OneLookUpIsWhatManyRaysConvergeTo
  Explain.SharesSumToThePixelOfTheWholePicture
  Robustness.TenMegabytesOnOneLineTakeLinearTime
  PROPERTIES COST 50)
