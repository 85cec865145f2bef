# cmake -D FROM=file -D TO=file -P cut_file.cmake: the first half of a file.
file(SIZE ${FROM} size)
math(EXPR half "${size} / 2")
file(READ ${FROM} text LIMIT ${half})
file(WRITE ${TO} "${text}")
