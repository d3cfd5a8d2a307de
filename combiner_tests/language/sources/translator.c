/* Texture stages of another interface, translated: calls inside of macros that check, tables, a stage given by number. */
#define EXTCALL(call)   ctx->extensions.call
#define CHECKED(call)   do { EXTCALL(call); check_error(#call); } while (0)

typedef enum { OP_SELECT, OP_MODULATE, OP_MODULATE2X, OP_ADD, OP_DOT3 } op_t;

struct op_args
{
    GLenum input[3];
    GLenum mapping[3];
    GLenum usage[3];
};

static const struct { GLenum scale, ab; GLboolean dot; } ops[] = {
    { GL_NONE,            GL_SPARE0_NV,  GL_FALSE },
    { GL_NONE,            GL_SPARE0_NV,  GL_FALSE },
    { GL_SCALE_BY_TWO_NV, GL_SPARE0_NV,  GL_FALSE },
    { GL_NONE,            GL_DISCARD_NV, GL_FALSE },
    { GL_NONE,            GL_SPARE0_NV,  GL_TRUE  },
};

static GLenum source_of(int stage, int argument)
{
    if (argument == 0) return GL_TEXTURE0_ARB + stage;
    return stage == 0 ? GL_PRIMARY_COLOR_NV : GL_SPARE0_NV;
}

void set_stage(struct context *ctx, int stage, int is_alpha, op_t op)
{
    struct op_args args = { { 0 }, { 0 }, { 0 } };
    GLenum portion = is_alpha ? GL_ALPHA : GL_RGB;
    GLenum target = GL_COMBINER0_NV + stage;
    int i;

    TRACE("stage %d, alpha %d, op %d\n", stage, is_alpha, op);

    for (i = 0; i < 2; ++i) {
        args.input[i] = source_of(stage, i);
        args.mapping[i] = op == OP_DOT3 ? GL_EXPAND_NORMAL_NV : GL_UNSIGNED_IDENTITY_NV;
        args.usage[i] = portion;
    }

    CHECKED(glCombinerInputNV(target, portion, GL_VARIABLE_A_NV, args.input[0], args.mapping[0], args.usage[0]));
    if (op == OP_SELECT || op == OP_ADD)
        CHECKED(glCombinerInputNV(target, portion, GL_VARIABLE_B_NV, GL_ZERO, GL_UNSIGNED_INVERT_NV, args.usage[0]));
    else
        CHECKED(glCombinerInputNV(target, portion, GL_VARIABLE_B_NV, args.input[1], args.mapping[1], args.usage[1]));

    if (op == OP_ADD) {
        CHECKED(glCombinerInputNV(target, portion, GL_VARIABLE_C_NV, args.input[1], args.mapping[1], args.usage[1]));
        CHECKED(glCombinerInputNV(target, portion, GL_VARIABLE_D_NV, GL_ZERO, GL_UNSIGNED_INVERT_NV, args.usage[1]));
    }
    CHECKED(glCombinerOutputNV(target, portion, ops[op].ab, GL_DISCARD_NV,
                               op == OP_ADD ? GL_SPARE0_NV : GL_DISCARD_NV, ops[op].scale, GL_NONE,
                               ops[op].dot, GL_FALSE, GL_FALSE));
}
