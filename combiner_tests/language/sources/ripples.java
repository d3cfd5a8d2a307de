/* A demo in Java: the calls are methods of an object, the enumerants belong to a class, arrays have an offset. */
package demos.ripples;

import net.java.games.jogl.*;

public class Ripples implements GLEventListener {
  private static final int STAGES = 3;
  private final float[] weights = new float[] { 0.25f, 0.5f, 1f, 0f };
  private boolean perStage = true;

  public void init(GLDrawable drawable) {
    GL gl = drawable.getGL();
    if (!gl.isExtensionAvailable("GL_NV_register_combiners")) {
      throw new RuntimeException("OpenGL extension \"GL_NV_register_combiners\" not available");
    }
    initCombiners(gl);
  }

  private void initCombiners(GL gl) {
    int stage = 0;
    gl.glCombinerParameteriNV(GL.GL_NUM_GENERAL_COMBINERS_NV, STAGES);
    gl.glCombinerParameterfvNV(GL.GL_CONSTANT_COLOR1_NV, weights, 0);
    // The sum of the neighbours.
    input(gl, stage, GL.GL_VARIABLE_A_NV, GL.GL_TEXTURE0_ARB);
    input(gl, stage, GL.GL_VARIABLE_C_NV, GL.GL_TEXTURE1_ARB);
    output(gl, stage, GL.GL_SPARE0_NV, GL.GL_SCALE_BY_ONE_HALF_NV);
    ++stage;
    input(gl, stage, GL.GL_VARIABLE_A_NV, GL.GL_SPARE0_NV);
    input(gl, stage, GL.GL_VARIABLE_C_NV, GL.GL_TEXTURE2_ARB);
    output(gl, stage, GL.GL_SPARE1_NV, GL.GL_NONE);
    ++stage;
    if (perStage) {
      float[] half = new float[] { 0.5f, 0.5f, 0.5f, 0.5f };
      gl.glCombinerStageParameterfvNV(GL.GL_COMBINER0_NV + stage, GL.GL_CONSTANT_COLOR0_NV, half, 0);
      gl.glEnable(GL.GL_PER_STAGE_CONSTANTS_NV);
    }
    input(gl, stage, GL.GL_VARIABLE_A_NV, GL.GL_SPARE1_NV);
    input(gl, stage, GL.GL_VARIABLE_C_NV, GL.GL_CONSTANT_COLOR0_NV);
    output(gl, stage, GL.GL_SPARE0_NV, GL.GL_NONE);
  }

  private void input(GL gl, int stage, int variable, int register) {
    final int one = variable + 1;
    gl.glCombinerInputNV(GL.GL_COMBINER0_NV + stage, GL.GL_RGB, variable, register, GL.GL_SIGNED_IDENTITY_NV, GL.GL_RGB);
    gl.glCombinerInputNV(GL.GL_COMBINER0_NV + stage, GL.GL_RGB, one, GL.GL_ZERO, GL.GL_UNSIGNED_INVERT_NV, GL.GL_RGB);
  }

  private void output(GL gl, int stage, int register, int scale) {
    gl.glCombinerOutputNV(GL.GL_COMBINER0_NV + stage, GL.GL_RGB, GL.GL_DISCARD_NV, GL.GL_DISCARD_NV, register, scale,
                          GL.GL_NONE, false, false, false);
  }
}
