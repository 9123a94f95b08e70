# find_package(goodbot), then target_link_libraries(your_program goodbot::goodbot).
get_filename_component(goodbot_folder "${CMAKE_CURRENT_LIST_DIR}/../../.." ABSOLUTE)
if(NOT TARGET goodbot::goodbot)
    add_library(goodbot::goodbot STATIC IMPORTED)
    set_target_properties(goodbot::goodbot PROPERTIES
        IMPORTED_LOCATION "${goodbot_folder}/lib/libgoodbot.a"
        INTERFACE_INCLUDE_DIRECTORIES "${goodbot_folder}/include")
endif()
