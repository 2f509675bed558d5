# Every text of the window stands in the Chinese translations, finished: a new one must not stay English.
set(copy ${SCRATCH}/terrawalk_zh_CN.ts)
configure_file(${SOURCE}/resources/i18n/terrawalk_zh_CN.ts ${copy} COPYONLY)
execute_process(
    COMMAND ${LUPDATE} -I . app/gui -ts ${copy} -locations none
        -disable-heuristic sametext -disable-heuristic similartext
    WORKING_DIRECTORY ${SOURCE} RESULT_VARIABLE failed OUTPUT_QUIET ERROR_VARIABLE told)
if(failed)
    message(FATAL_ERROR "lupdate: ${told}")
endif()
file(READ ${copy} texts)
string(REGEX MATCHALL "<source>[^<]*</source>[^<]*<translation type=\"unfinished\"" open "${texts}")
list(LENGTH open count)
if(count GREATER 0)
    string(REGEX REPLACE "[^<]*<translation type=.unfinished." "" open "${open}")
    message(FATAL_ERROR "${count} texts are not translated: ${open}")
endif()
string(REGEX MATCHALL "<source>" all "${texts}")
list(LENGTH all count)
if(count LESS 500)
    message(FATAL_ERROR "only ${count} texts were found")
endif()
