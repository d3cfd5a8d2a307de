# Labels of tests besides their room's. CTest reads this file after the lists of tests, whose names the patterns match as
# ROOM.SUITE.TEST. A step of .ci/run or a verb of ./dev chooses tests by these labels alone (ctest -L, -LE).

set(ninebit_rooms numerics combiner language structure capi raster system scene image effect playground shadow study gl_layer bench
    tools examples)

# Too long for the step with sanitizers, and something else there checks the same lines:
set(ninebit_without_sanitizers
    # Other numbers of threads, other SIMD targets, one computation again and again: the first step runs them.
    AnyNumberOfThreads Threads PreparedDraw[.]AnyThreads OnEverySimdTarget Adversarial SharedTiles
    # Loops over all inputs of an operation, or over very many.
    Faults.Are.*ForMegabytes IndexCompare "IndexSteps[.](Every|Counts)" ExhaustiveSum DatapathErrors[.]OfAll
    EveryMappingOfEvery NoPairOf65536 TheMuxComparesLowBytes VolumeRandom Trace[.]EveryStep TwoBytesHold16 DigitsInBase
    "Equivalence[.](Random|TheSolver|FourLive)" "Stability[.](TheArticles|EachField)" FindTheAssignmentOfACard Examples[.]ChipKit
    GlLegality RandomStatesComeBack EmitC EmitGlsl ExactArithmeticDecides "ProgramErrors[.](All|Stages|Units|Biases)"
    # Damage to texts: the fuzzers do it to the same parsers with the same sanitizers.
    DamagedTexts BrokenTexts
    # How long a text takes.
    LongLogsTake OfAHundredMegabytes
    # What the program only asks of libraries whose own tests stay, and their longest tests. The golden hashes are
    # another build's.
    EnginesAgreeWithTheLibrary EveryFormToEveryOther ValuesOfRender StudyRun StudyParts StepOneDropsTheShadow
    Cookie[.]FacesThatDoNotFit "DepthCube[.](AgreesWith|MoreBits|StopsBetween)" tools[.]Interrupt EvalStream
    TooManyPolygons OnEveryTarget TheBoundHoldsOnAllScenes
    "tools[.](Study|Habits|Verbs|UsageError|Verify|Convert|TraceVerb|Cookie|ProfileFile|Prove|Kit|Vectors|All/Pictures|All/RealScenes)"
      OtherPrograms IndexStepsStudy IndexRoom[.]Objects DepthCubeCombiners[.]BothPasses tools[.]Bench NoByteMayBeMissing
    WhileAReportIsWritten Limits[.]A LightInSolid JsonSchema Nv20Of EachFaceOfTheMapCasts RowRules TechniqueTable
    AlteredPart OtherKinds Flags[.]OfAll
    # The leak sanitizer's own thread crashes now and then at the end of a program that has read pictures.
    TexturedRender "tools[.]Draw[.](TheGallery|Answers)" "Examples[.](TextureIo|EffectFiles)")

# Minutes without optimization, and no line that another test does not reach:
set(ninebit_without_coverage
    DepthCompare IndexCompare Sums Products NarrowLanes "FinalArithmetic.*Every" "GeneralArithmetic.*Every"
    EveryMappingOfEvery SizesAndLanesPast ForMegabytes GlLegality RandomStatesComeBack BrokenTexts Damage "EmitC[.](Random|TheGallery)"
    EmitGlsl EveryStepOfRandom "Nv[12]0Of" "Threads[.]")

foreach(label IN ITEMS without_sanitizers without_coverage)
  list(JOIN ninebit_${label} "|" ninebit_${label}_pattern)
endforeach()
foreach(room IN LISTS ninebit_rooms)
  foreach(test IN LISTS ninebit_${room}_tests_TESTS)
    set(labels ${room})
    foreach(label IN ITEMS without_sanitizers without_coverage)
      if(test MATCHES "${ninebit_${label}_pattern}")
        list(APPEND labels ${label})
      endif()
    endforeach()
    if(NOT labels STREQUAL room)
      set_tests_properties("${test}" PROPERTIES LABELS "${labels}")
    endif()
  endforeach()
endforeach()
