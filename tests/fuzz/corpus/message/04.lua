return 40000
