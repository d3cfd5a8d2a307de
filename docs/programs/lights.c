/*
 * Lights of a first-person shooter, in the manner of the engines of 2001: function pointers with a prefix, macros for
 * what repeats, display lists, settings of the console.
 */
#include "r_local.h"

#define UNIT( n )       ( GL_TEXTURE0_ARB + ( n ) )
#define UNUSED_INPUT    GL_ZERO, GL_UNSIGNED_IDENTITY_NV, GL_RGB
#define RC_INPUT( stage, var, reg, map, usage ) \
	xglCombinerInputNV( GL_COMBINER##stage##_NV, GL_RGB, GL_VARIABLE_##var##_NV, reg, map, usage )

#ifdef _WIN32
PFNGLCOMBINERINPUTNVPROC	xglCombinerInputNV;
PFNGLCOMBINEROUTPUTNVPROC	xglCombinerOutputNV;
#endif

enum { UNIT_NORMALS, UNIT_VECTORS, UNIT_COLORS };

static const GLfloat	r_half[4] = { 0.5f, 0.5f, 0.5f, 1 };

static void R_LightFragments( void ) {
	if ( r_lists->integer ) {
		xglCallList( lightFragmentsList );
		return;
	}
	xglCombinerParameteriNV( GL_NUM_GENERAL_COMBINERS_NV, 2 );
	xglCombinerParameterfvNV( GL_CONSTANT_COLOR0_NV, r_half );

	/* the normal . the light's vector */
	RC_INPUT( 0, A, UNIT( UNIT_NORMALS ), GL_EXPAND_NORMAL_NV, GL_RGB );
	RC_INPUT( 0, B, UNIT( UNIT_VECTORS ), GL_EXPAND_NORMAL_NV, GL_RGB );
	xglCombinerOutputNV( GL_COMBINER0_NV, GL_RGB, GL_SPARE0_NV, GL_DISCARD_NV, GL_DISCARD_NV, GL_NONE, GL_NONE,
						 GL_TRUE, GL_FALSE, GL_FALSE );

	RC_INPUT( 1, A, GL_SPARE0_NV, GL_UNSIGNED_IDENTITY_NV, GL_RGB );
	RC_INPUT( 1, B, UNIT( UNIT_COLORS ), GL_UNSIGNED_IDENTITY_NV, GL_RGB );
	xglCombinerOutputNV( GL_COMBINER1_NV, GL_RGB, GL_SPARE0_NV, GL_DISCARD_NV, GL_DISCARD_NV, GL_SCALE_BY_TWO_NV,
						 GL_NONE, GL_FALSE, GL_FALSE, GL_FALSE );

	xglFinalCombinerInputNV( GL_VARIABLE_A_NV, UNUSED_INPUT );
	xglFinalCombinerInputNV( GL_VARIABLE_B_NV, UNUSED_INPUT );
	xglFinalCombinerInputNV( GL_VARIABLE_C_NV, UNUSED_INPUT );
	xglFinalCombinerInputNV( GL_VARIABLE_D_NV, GL_SPARE0_NV, GL_UNSIGNED_IDENTITY_NV, GL_RGB );
	xglFinalCombinerInputNV( GL_VARIABLE_G_NV, GL_ZERO, GL_UNSIGNED_INVERT_NV, GL_ALPHA );
}

/* what the passes of a light have in common */
void R_DrawLight( const light_t *light, qboolean first ) {
	GLfloat		color[4];
	int			i;

	for ( i = 0 ; i < 3 ; i++ ) {
		color[i] = light->color[i] * ( first ? 1.0f : 0.5f );
	}
	color[3] = 1.0f;

	GL_State( GLS_DEPTHMASK_FALSE | GLS_SRCBLEND_ONE | GLS_DSTBLEND_ONE );
	R_BindNormalMap( light->surface );
	xglEnable( GL_REGISTER_COMBINERS_NV );
	xglCombinerParameterfvNV( GL_CONSTANT_COLOR1_NV, color );
	R_LightFragments();
	xglEnable( GL_TEXTURE_2D );
	xglDrawElements( GL_TRIANGLES, light->numIndexes, GL_UNSIGNED_INT, light->indexes );
}
