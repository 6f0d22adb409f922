function answer = calibrate(case_, varargin)
%CALIBRATE  Cutting coefficients and runout from a measured wall, without a dynamometer.
%
%   answer = trochoid.calibrate(case_) of a case file, or of a struct of its tables.
%
%   See also trochoid.run, which says what the answer holds and which options there are.
answer = trochoid.run('calibrate', case_, varargin{:});
end
