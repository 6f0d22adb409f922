function answer = sweep(case_, varargin)
%SWEEP  Parameter sweep ([sweep]): one row per case in one table;
%   resumes where it was stopped.
%
%   answer = trochoid.sweep(case_) of a case file, or of a struct of its tables.
%
%   See also trochoid.run, which says what the answer holds and which options there are.
answer = trochoid.run('sweep', case_, varargin{:});
end
