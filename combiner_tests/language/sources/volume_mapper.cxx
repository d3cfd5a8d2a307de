/*  Volume rendering with the entry points and the enumerants in a namespace.  */
#include "volumegl.h"

void VolumeMapper::SetupOneComponent(Volume *vol)
{
  float ambient  = vol->GetProperty()->GetAmbient();
  float light[4] = { 0.25, 0.5, 0.75, 0.0 };
  float strengths[2][4];
  int pass, axis;

  for (pass = 0; pass < 2; pass++)
    {
    for (axis = 0; axis < 4; axis++)
      {
      strengths[pass][axis] = (pass == 0) ? light[axis] : 1.0 - light[axis];
      }
    }

  volumegl::ActiveTexture(volumegl::TEXTURE0);
  glDisable(GL_TEXTURE_2D);
  glEnable(volumegl::TEXTURE_3D_EXT);

  glEnable(volumegl::REGISTER_COMBINERS_NV);
  volumegl::CombinerParameteriNV(volumegl::NUM_GENERAL_COMBINERS_NV, 2);
  volumegl::CombinerParameteriNV(volumegl::COLOR_SUM_CLAMP_NV, GL_TRUE);

  for (int stage = 0; stage < 2; ++stage)
    {
    GLenum where = volumegl::COMBINER0_NV + stage;
    volumegl::CombinerStageParameterfvNV(where, volumegl::CONSTANT_COLOR0_NV, strengths[stage]);
    volumegl::CombinerInputNV(where, GL_RGB, volumegl::VARIABLE_A_NV,
                              stage == 0 ? volumegl::TEXTURE0 : volumegl::SPARE0_NV,
                              stage == 0 ? volumegl::EXPAND_NORMAL_NV : volumegl::SIGNED_IDENTITY_NV, GL_RGB);
    volumegl::CombinerInputNV(where, GL_RGB, volumegl::VARIABLE_B_NV,
                              volumegl::CONSTANT_COLOR0_NV, volumegl::UNSIGNED_IDENTITY_NV, GL_RGB);
    volumegl::CombinerOutputNV(where, GL_RGB, volumegl::SPARE0_NV, volumegl::DISCARD_NV, volumegl::DISCARD_NV,
                               GL_NONE, GL_NONE, stage == 0, GL_FALSE, GL_FALSE);
    }

  glEnable(volumegl::PER_STAGE_CONSTANTS_NV);

  if (ambient > 0.5)
    {
    volumegl::FinalCombinerInputNV(volumegl::VARIABLE_D_NV, volumegl::SPARE1_NV,
                                   volumegl::UNSIGNED_IDENTITY_NV, GL_RGB);
    }
  else
    {
    volumegl::FinalCombinerInputNV(volumegl::VARIABLE_D_NV, volumegl::SPARE0_NV,
                                   volumegl::UNSIGNED_IDENTITY_NV, GL_RGB);
    }
}
