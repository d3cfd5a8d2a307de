// A back end that fills display lists once: each function calls its list later, by a console variable.
enum { LIST_DIFFUSE, LIST_BUMP, LIST_COUNT };

unsigned int listBase;

static void DiffuseFragment(void) {
  if (r_combinerLists.GetBool()) {
    qglCallList(listBase + LIST_DIFFUSE);
    return;
  }
  qglCombinerParameteriNV(GL_NUM_GENERAL_COMBINERS_NV, 1);
  qglCombinerInputNV(GL_COMBINER0_NV, GL_RGB, GL_VARIABLE_A_NV, GL_TEXTURE0_ARB, GL_UNSIGNED_IDENTITY_NV, GL_RGB);
}

static void BumpFragment(void) {
  if (r_combinerLists.GetBool()) {
    qglCallList(listBase + LIST_BUMP);
    return;
  }
  qglCombinerParameteriNV(GL_NUM_GENERAL_COMBINERS_NV, 2);
  qglCombinerInputNV(GL_COMBINER1_NV, GL_RGB, GL_VARIABLE_A_NV, GL_TEXTURE1_ARB, GL_EXPAND_NORMAL_NV, GL_RGB);
}

void InitCombiners(void) {
  if (!glConfig.registerCombinersAvailable) {
    common->Printf("Not available.\n");
    return;
  }
  listBase = qglGenLists(LIST_COUNT);
  bool before = r_combinerLists.GetBool();
  r_combinerLists.SetBool(false);
  qglNewList(listBase + LIST_DIFFUSE, GL_COMPILE);
  DiffuseFragment();
  qglEndList();
  qglNewList(listBase + LIST_BUMP, GL_COMPILE);
  BumpFragment();
  qglEndList();
  r_combinerLists.SetBool(before);
}
