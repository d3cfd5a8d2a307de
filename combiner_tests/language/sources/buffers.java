package demo;

import java.nio.FloatBuffer;
import org.lwjgl.BufferUtils;
import static org.lwjgl.opengl.NVRegisterCombiners.*;

/** Constants in buffers, as LWJGL takes them. */
public class Buffers {
  private final FloatBuffer colour = BufferUtils.createFloatBuffer(4);

  private static FloatBuffer buffer(float... values) {
    FloatBuffer made = BufferUtils.createFloatBuffer(values.length);
    made.put(values);
    made.flip();
    return made;
  }

  public void chained() {
    FloatBuffer light = BufferUtils.createFloatBuffer(4);
    light.put(0.25f).put(0.5f).put(0.75f).put(1f).flip();
    glCombinerParameterNV(GL_CONSTANT_COLOR0_NV, light);
    glCombinerParameterNV(GL_CONSTANT_COLOR1_NV, buffer(new float[] {1, 0, 0, 1}));
    glCombinerParameteriNV(GL_NUM_GENERAL_COMBINERS_NV, 1);
  }

  public void byIndex() {
    FloatBuffer light = ByteBuffer.allocateDirect(16).order(ByteOrder.nativeOrder()).asFloatBuffer();
    light.put(3, 1f);
    light.put(0, 0.5f);
    for (int i = 1; i < 3; i++) light.put(i, 0.125f * i);
    light.rewind();
    glCombinerParameterNV(GL_CONSTANT_COLOR0_NV, light);
  }

  public void fromElsewhere(float red) {
    FloatBuffer light = BufferUtils.createFloatBuffer(4);
    light.put(red).put(0).put(0).put(1);
    light.flip();
    glCombinerParameterNV(GL_CONSTANT_COLOR0_NV, light);
  }
}
