{ A demo in Delphi: words in any case, arrays from 1, pointers by @. }
unit Water;

interface

uses
  Windows, OpenGL12;

type
  TColor = array[1..4] of GLfloat;
  TQuality = (qLow, qMedium, qHigh);

  TWater = class(TObject)
  private
    FQuality: TQuality;
  public
    procedure SetupCombiners(Unit0: GLenum; Quality: TQuality);
  end;

procedure Reset;

implementation

const
  Deep: TColor = (0.0, 0.125, 0.25, 1.0);
  Inputs: array[0..3] of GLenum = (GL_TEXTURE0_ARB, GL_PRIMARY_COLOR_NV, GL_ZERO, GL_ZERO);

procedure TWater.SetupCombiners(Unit0: GLenum; Quality: TQuality);
var
  i: Integer;
  Shallow: TColor;
begin
  GLCombinerParameteriNV(GL_NUM_GENERAL_COMBINERS_NV, 1);
  glCombinerParameterfvNV(GL_CONSTANT_COLOR0_NV, @Deep);
  for i := 1 to 4 do Shallow[i] := Deep[i] * 2;
  glCombinerParameterfvNV(GL_CONSTANT_COLOR1_NV, @Shallow[1]);

  for i := 0 to 3 do
    glCombinerInputNV(GL_COMBINER0_NV, GL_RGB, GL_VARIABLE_A_NV + i, Inputs[i], GL_UNSIGNED_IDENTITY_NV, GL_RGB);

  case Quality of
    qLow, qMedium:
      glCombinerOutputNV(GL_COMBINER0_NV, GL_RGB, GL_SPARE0_NV, GL_DISCARD_NV, GL_DISCARD_NV,
        GL_NONE, GL_NONE, False, False, False);
    qHigh:
      begin
        glCombinerInputNV($8550, GL_RGB, GL_VARIABLE_C_NV, Unit0, GL_EXPAND_NORMAL_NV, GL_RGB);
        glCombinerOutputNV(GL_COMBINER0_NV, GL_RGB, GL_DISCARD_NV, GL_DISCARD_NV, GL_SPARE0_NV,
          GL_SCALE_BY_TWO_NV, GL_NONE, False, False, False);
      end;
  end;
  glFinalCombinerInputNV(GL_VARIABLE_D_NV, GL_SPARE0_NV, GL_UNSIGNED_IDENTITY_NV, GL_RGB);
  glEnable(GL_REGISTER_COMBINERS_NV);
end;

procedure Reset;
begin
  glDisable(GL_REGISTER_COMBINERS_NV);
end;

end.
