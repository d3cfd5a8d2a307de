// A demo in C#: static methods and enumerants of a class, references to the first of several numbers.
using System;
using Tao.OpenGl;

namespace Demos {
  public class Glow {
    private const int Last = 1;
    readonly float[] tint = { 1.0f, 0.5f, 0.25f, 1 };

    public void Setup(bool bright) {
      Gl.glCombinerParameteriNV(Gl.GL_NUM_GENERAL_COMBINERS_NV, Last + 1);
      Gl.glCombinerParameterfvNV(Gl.GL_CONSTANT_COLOR0_NV, ref tint[0]);
      foreach (int unit in new int[] { 0, 1 }) { Bind(unit); }
      for (int i = 0; i <= Last; i++) {
        int register = i == 0 ? Gl.GL_TEXTURE0_ARB : Gl.GL_SPARE0_NV;
        Gl.glCombinerInputNV(Gl.GL_COMBINER0_NV + i, Gl.GL_RGB, Gl.GL_VARIABLE_A_NV, register, Gl.GL_UNSIGNED_IDENTITY_NV, Gl.GL_RGB);
        Gl.glCombinerInputNV(Gl.GL_COMBINER0_NV + i, Gl.GL_RGB, Gl.GL_VARIABLE_B_NV, Gl.GL_CONSTANT_COLOR0_NV, Gl.GL_UNSIGNED_IDENTITY_NV, Gl.GL_RGB);
        Gl.glCombinerOutputNV(Gl.GL_COMBINER0_NV + i, Gl.GL_RGB, Gl.GL_SPARE0_NV, Gl.GL_DISCARD_NV, Gl.GL_DISCARD_NV,
          bright ? Gl.GL_SCALE_BY_FOUR_NV : Gl.GL_NONE, Gl.GL_NONE, 0, 0, 0);
      }
      Gl.glEnable(Gl.GL_REGISTER_COMBINERS_NV);
    }
  }
}
